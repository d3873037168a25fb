#include "transport/organ_shares.h"

#include <algorithm>
#include <vector>

#include "optics/bsdf.h"

namespace quasimc {
namespace {

std::vector<double> measured_areas(const Scene& scene) {
    std::vector<double> areas;
    for (const Organ& organ : scene.organs()) {
        if (organ.measured && organ.area > 0) {
            areas.push_back(organ.area);
        }
    }
    return areas;
}

double middle_of(std::vector<double> values) {
    if (values.empty()) {
        return 0;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

double median_measured_area(const Scene& scene) {
    return middle_of(measured_areas(scene));
}

double seen_area(const Scene& scene) {
    const Cell& cell = scene.cell();
    if (cell.along_x && cell.along_y) {
        return cell.size_x * cell.size_y;
    }
    const Vec3 size = scene.bounds().size();
    return (size.x * size.y + size.y * size.z + size.z * size.x) / 2;
}

double followed_peak(const Scene& scene) {
    // A sample through a peak contributes half of it; there are light subpaths for all organs.
    constexpr double kPart = 0.5, kMost = 1e5;
    if (data_of(scene).sensors != nullptr) {
        return kMost;  // no light subpath hits a point
    }
    const std::vector<double> areas = measured_areas(scene);
    const double found = static_cast<double>(areas.size()) * middle_of(areas);
    return found > 0 ? std::clamp(kPart * seen_area(scene) / found, kNarrowPeak, kMost)
                     : kNarrowPeak;
}

}  // namespace quasimc

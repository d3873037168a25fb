#include "solvers/ray_bundles/line_statistics.h"

#include "base/checks.h"

namespace quasimc {
namespace {

/// The minimum mean number of lines that meet a corrected region: with fewer, at times none does.
constexpr double kMinMeetings = 10;

}  // namespace

MetAreas met_areas(const PatchScene& scene, std::span<const double> found, double lines_per_area) {
    EXPECT(found.size() == scene.surfaces.size());
    const std::vector<double>& areas = scene.region_areas;
    MetAreas met{
        std::vector<double>(areas.size()), std::vector<double>(areas.size(), 1),
        std::vector<bool>(areas.size())};
    for (std::size_t i = 0; i < found.size(); ++i) {
        met.found[scene.surfaces[i].region] += found[i];
    }
    for (std::size_t region = 0; region < areas.size(); ++region) {
        if (areas[region] * lines_per_area >= kMinMeetings && met.found[region] > 0) {
            met.is_corrected[region] = true;
            met.corrections[region] = areas[region] / met.found[region];
        }
    }
    return met;
}

}  // namespace quasimc

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stress/ways.h"

namespace quasimc::stress {
namespace {

/// Irradiance of all far sources, and of lamps as far away as the scene is large; per band.
std::vector<double> irradiance_of(const Node& document, const Scene& scene) {
    const std::size_t bands = scene.bands().size();
    const double radius = scene.bounds().radius();
    std::vector<double> sum(bands);
    for (const Node* source : tables_at(document, "source")) {
        for (const char* key : {"irradiance_facing", "irradiance_horizontal"}) {
            const std::vector<double> values = per_band_at(*source, key, bands, 0);
            for (std::size_t b = 0; b < bands; ++b) {
                sum[b] += values[b];
            }
        }
        const std::vector<double> power = per_band_at(*source, "power", bands, 0);
        for (std::size_t b = 0; b < bands; ++b) {
            sum[b] += power[b] / (4 * std::numbers::pi * radius * radius);
        }
    }
    return sum;
}

/// The smallest height of the organ's triangles, relative to the scene or its cell.
double thinness_of(const Scene& scene, const Organ& organ) {
    const Cell& cell = scene.cell();
    const double size = std::max(
        {scene.bounds().radius(), cell.along_x ? cell.size_x : 0, cell.along_y ? cell.size_y : 0});
    double least = 1;
    for (const Triangle& t : scene.triangles_of(organ)) {
        const double longest =
            std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
        const double height = length(area_vector(t)) / longest;
        if (height > 0) {  // a triangle of zero area receives no light
            least = std::min(least, height / size);
        }
    }
    return least;
}

}  // namespace

std::vector<double> slips_of(const Node& document, const Scene& scene) {
    constexpr double kSlip = 1e-6;
    std::vector<double> slips;
    const std::vector<double> light = irradiance_of(document, scene);
    double organs = 0, ground = 0;
    for (const Organ& organ : scene.organs()) {
        (organ.is_ground ? ground : organs) += organ.area;
        for (const Quantity q : kComparedQuantities) {
            for (const double e : light) {
                slips.push_back(kSlip * e * (q == Quantity::absorbed_flux ? organ.area : 1));
            }
        }
        slips.push_back(kSlip);
    }
    for (const double e : light) {
        slips.push_back(kSlip * e * organs);
        slips.push_back(kSlip * e * ground);
    }
    return slips;
}

/// 5e-6, as start areas of beams exceed the scene by 2^-20 on each side. For needles five times the
/// rounding of a ray's position (2^-22 of the scene) relative to their width.
std::vector<double> roundings_of(const Scene& scene) {
    constexpr double kRounding = 5e-6;
    constexpr double kNeedle = 1e-3;
    const std::size_t each = kComparedQuantities.size() * scene.bands().size() + 1;
    std::vector<double> roundings;
    double area = 0, weighted = 0;
    for (const Organ& organ : scene.organs()) {
        const double thinness = thinness_of(scene, organ);
        const double own = thinness > kNeedle ? kRounding : 5 * 0x1p-22 / thinness;
        roundings.insert(roundings.end(), each, own);
        area += organ.area;
        weighted += organ.area * own;
    }
    const double of_totals = area > 0 ? weighted / area : kRounding;
    roundings.insert(roundings.end(), 2 * scene.bands().size(), of_totals);
    return roundings;
}

}  // namespace quasimc::stress

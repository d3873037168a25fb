#include "solvers/ray_bundles/sky_view.h"

#include <algorithm>
#include <numbers>

namespace quasimc {
namespace {

/// Directions with a density below the uniform one by more than this factor count less.
constexpr double kMaxWeight = 4;
/// The minimum surrounded fraction of a corrected side. Below it a side receives little scattered
/// light, and the difference of area and open area is too noisy.
constexpr double kMinSurrounded = 0.25;
constexpr double kHemisphere = 2 * std::numbers::pi;

}  // namespace

double sky_weight(const SkyDirections& skies, const Vec3& travel) {
    return std::min(1.0, kMaxWeight * kHemisphere * skies.density(travel));
}

void add_open_pixels(
    const PatchScene& scene, const ItemBuffer& image, double weight, OpenAreas& open) {
    for (const ItemBuffer::Item& item : image.items()) {
        const std::uint32_t region = scene.prepared.region(item.triangle);
        open[2 * std::size_t{region} + (item.cosine > 0 ? 1 : 0)] += weight * item.pixels;
    }
}

void add_open_ends(
    const PatchScene& scene, std::span<const std::uint32_t> sides, double weight, OpenAreas& open) {
    for (const std::size_t side : sides) {
        open[2 * std::size_t{scene.region_of_patch[side / 2]} + side % 2] += weight;
    }
}

std::vector<bool> surrounded_sides(const LineStatistics& lines) {
    std::vector<bool> is_surrounded(lines.open.size());
    for (std::size_t i = 0; i < lines.open.size(); ++i) {
        const double met = lines.areas.found[i / 2];
        is_surrounded[i] = met > 0 && lines.open[i] <= (1 - kMinSurrounded) * met;
    }
    return is_surrounded;
}

std::vector<double> sky_view_corrections(
    const PatchScene& scene,
    const OpenAreas& pixels,
    const LineStatistics& lines,
    const std::vector<bool>& is_surrounded) {
    std::vector<double> corrections(2 * scene.region_areas.size(), 1);
    for (std::size_t i = 0; i < lines.open.size(); ++i) {
        const std::size_t region = i / 2;
        if (is_surrounded[i] && lines.areas.is_corrected[region]) {
            const double area = scene.region_areas[region];
            const double by_pixels = area - pixels[i];
            const double by_lines = area - lines.open[i] * lines.areas.corrections[region];
            corrections[i] = by_pixels > 0 && by_lines > 0 ? by_pixels / by_lines : 1;
        }
    }
    return corrections;
}

}  // namespace quasimc

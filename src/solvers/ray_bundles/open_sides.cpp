#include "solvers/ray_bundles/open_sides.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasimc {
namespace {

/// Directions that are drawn more seldom than evenly by more than this count less.
constexpr double kMostWeight = 4;
/// A side of which less is surrounded gets little scattered light, and what is left when all that
/// is open is taken from it is not known well enough.
constexpr double kLeastSurrounded = 0.25;
constexpr double kHemisphere = 2 * std::numbers::pi;

}  // namespace

OpenSides::OpenSides(const PatchScene& patches, const SkyDirections& skies)
    : patches_(patches), skies_(skies) {
    if (skies.skies().empty()) {
        return;
    }
    for (const PatchScene::Surface& surface : patches.surfaces) {
        region_of_.resize(patches.patches.first(surface.triangle + 1), surface.region);
    }
    const std::size_t sides = 2 * patches.prepared.scene().regions().size();
    seen_.resize(sides);
    open_.resize(sides);
    is_surrounded_.resize(sides);
}

void OpenSides::clear() {
    std::fill(seen_.begin(), seen_.end(), 0);
    std::fill(open_.begin(), open_.end(), 0);
    std::fill(is_surrounded_.begin(), is_surrounded_.end(), false);
}

double OpenSides::share_of(const Vec3& travel) const {
    return std::min(1.0, kMostWeight * kHemisphere * skies_.density(travel));
}

void OpenSides::add_seen(
    const ItemBuffer& pixels, const DrawnDirection& from, std::uint32_t count) {
    // An exitance of 1 is a radiance of 1 / pi.
    const double weight =
        share_of(from.direction) / (from.density * count) / std::numbers::pi * pixels.pixel_area();
    for (const ItemBuffer::Item& item : pixels.items()) {
        const std::uint32_t region = patches_.prepared.region(item.triangle);
        seen_[2 * std::size_t{region} + (item.cosine > 0 ? 1 : 0)] += weight * item.pixels;
    }
}

void OpenSides::add_ends(
    std::span<const std::uint32_t> sides, const Vec3& direction, double weight) {
    const double share = weight * share_of(-1 * direction);
    for (const std::size_t side : sides) {
        open_[2 * std::size_t{region_of_[side / 2]} + side % 2] += share;
    }
}

void OpenSides::choose_sides(const PatchLight& light) {
    for (std::size_t i = 0; i < open_.size(); ++i) {
        const double met = light.area_met(static_cast<std::uint32_t>(i / 2));
        is_surrounded_[i] = met > 0 && open_[i] <= (1 - kLeastSurrounded) * met;
    }
}

double OpenSides::correction(
    std::uint32_t region, SurfaceSide side, const PatchLight& light) const {
    const std::size_t i = 2 * std::size_t{region} + index_of(side);
    if (open_.empty() || !is_surrounded_[i] || !light.is_corrected(region)) {
        return 1;
    }
    const double area = light.area_of(region);
    const double seen = area - seen_[i];
    const double found = area - open_[i] * light.correction(region);
    return seen > 0 && found > 0 ? seen / found : 1;
}

}  // namespace quasimc

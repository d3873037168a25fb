#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/item_buffer.h"
#include "solvers/ray_bundles/patch_light.h"
#include "transport/sky_directions.h"

namespace quasimc {

/// How much of what the sides of regions see is the sky.
///
/// Lines that meet nothing bring a side no scattered light, and how many of them do so by chance is
/// most of the noise of scattered light where surroundings are equally bright. The item buffers of
/// direct skylight know that much better; so what lines brought is divided by the area of what they
/// found to be surrounded, and multiplied by what it is according to the item buffers. A
/// replicate's own; used by one thread.
class OpenSides {
  public:
    OpenSides(const PatchScene& patches, const SkyDirections& skies);

    /// Forgets all, before another replicate.
    void clear();
    /// Adds what is seen along one of `count` directions that were drawn for skies.
    void add_seen(const ItemBuffer& pixels, const DrawnDirection& from, std::uint32_t count);
    /// Adds lines along a direction (upwards) that end on the sky, each of so much weight.
    /// @param sides  of the patches that they leave last, [2 * patch + side]
    void add_ends(std::span<const std::uint32_t> sides, const Vec3& direction, double weight);
    /// Lets the ends added until now tell which sides are surrounded so much that a correction is
    /// of use: lines of a step other than the one that is corrected.
    void choose_sides(const PatchLight& light);
    void forget_ends() { std::fill(open_.begin(), open_.end(), 0); }

    /// The factor for scattered light that came to a side in the last step. To be asked after
    /// PatchLight::correct_areas().
    [[nodiscard]] double correction(
        std::uint32_t region, SurfaceSide side, const PatchLight& light) const;

  private:
    /// How much a direction counts, whatever the sky's radiance there: not more than a few times
    /// the density with which it is drawn. @param travel  of the light
    [[nodiscard]] double share_of(const Vec3& travel) const;

    const PatchScene& patches_;
    const SkyDirections& skies_;
    std::vector<std::uint32_t> region_of_;  // by patch
    std::vector<double> seen_, open_;       // area, by 2 * region + side
    std::vector<bool> is_surrounded_;       // enough to be corrected; the same
};

}  // namespace quasimc

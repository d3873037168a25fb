#pragma once

#include <cstdint>
#include <vector>

#include "solvers/ray_bundles/patch_light.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Light that bright spots of direct light add to what their patches scatter: of either sign, 0 in
/// all.
struct SpotLight {
    /// Light that leaves the scene along a direction.
    struct Escaped {
        Vec3 direction;
        std::vector<double> flux;  ///< [band]
    };
    std::vector<double> on_regions;  ///< flux, [2 * region + side][band]
    std::vector<Escaped> escaped;
    std::uint64_t rays = 0;
};

/// Corrects the first order of scattering where direct light varies within a patch that is far
/// brighter than all that its organ sees: below a slit beside a wall, say. There light from the
/// mean of a patch would fall on the wrong surfaces.
///
/// Pairs of points on such a patch are lit by the same light. Where only one of them is, a ray that
/// carries light leaves it, and one that takes as much leaves the other, in the same direction.
/// Their mean is the difference between the light that the patch scatters and that of its mean.
/// @param irradiance  of the first order of scattering, whose memory still holds the exitance that
///        was sent; the light that arrives on patches is added
/// @param paths  per replicate, of which the number of pairs is a part
/// @param key  of the replicate's random numbers
[[nodiscard]] SpotLight trace_bright_spots(
    const PreparedScene& prepared, double paths, std::uint64_t key, PatchIrradiance& irradiance);

}  // namespace quasimc

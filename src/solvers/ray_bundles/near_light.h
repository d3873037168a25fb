#pragma once

#include <cstdint>
#include <vector>

#include "solvers/ray_bundles/near_lines.h"
#include "solvers/ray_bundles/patch_light.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Light that goes less far than a patch is wide, minus what its patch sends instead: of either
/// sign, 0 in all.
struct NearLight {
    /// Light that leaves the scene along a direction.
    struct Escaped {
        Vec3 direction;
        std::vector<double> flux;  ///< [column]
    };
    std::vector<double> on_regions;  ///< flux, [2 * region + side][column]
    std::vector<Escaped> escaped;
    std::uint64_t rays = 0;
};

/// Corrects the first order of scattering where surfaces receive much of it from near: under a leaf
/// that lies on lit soil, or on a lid beside a lit wall. There light from the mean of a patch would
/// fall on the wrong surfaces.
///
/// Pairs of points on such a patch are lit by the same light. Where only one of them is, a ray that
/// carries light leaves it, and one that takes as much leaves the other, in the same direction.
/// Their mean is the difference between the light that the patch scatters and that of its mean.
/// @param light  after the first order of scattering, whose memory still holds the exitance that
///        was sent; the light that arrives on patches is added
/// @param paths  per replicate, of which the number of pairs is a part
/// @param key  of the replicate's random numbers
[[nodiscard]] NearLight trace_near_light(
    const PreparedScene& prepared,
    const NearLines& lines,
    double paths,
    std::uint64_t key,
    PatchLight& light);

}  // namespace quasimc

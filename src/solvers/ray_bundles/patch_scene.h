#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "raster/line_hits.h"
#include "raster/patches.h"
#include "solvers/ray_bundles/patch_optics.h"
#include "solvers/ray_bundles/solved_bands.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Cuts the triangles of the caster's mesh into patches of about equal areas
/// (solvers/ray_bundles/patch_size.h), at least four a triangle, and along intersections of
/// surfaces. Periodic images have none.
/// @param most  approximate number of patches, unless shadows of organs need more
/// @throws InputError  if the search for intersections would take too long
/// @throws StopRequested  if a stop was requested
[[nodiscard]] Patches make_patches(
    const PreparedScene& prepared,
    std::span<const VisibilityRole> roles,
    double most,
    const std::stop_token& stop);

/// The Lambertian surfaces of a scene and their patches. Const, shared by all threads.
struct PatchScene {
    /// @param projection  input of projections
    /// @param solved  which outlive it
    PatchScene(
        const PreparedScene& scene,
        const SolvedBands& solved,
        const ProjectedScene& projection,
        Patches cut);

    /// A triangle that has patches.
    struct Surface {
        std::uint32_t triangle = 0, region = 0, material = 0;
        double area = 0;  ///< local units squared
        /// Light on it over light on its rounded corners: 1 except for slivers.
        double exact_share = 1;
        bool is_sensor = false;
    };

    const PreparedScene& prepared;
    const SolvedBands& bands;  ///< the columns of light on patches
    const ProjectedScene& projected;
    Patches patches;
    std::vector<Surface> surfaces;
    std::vector<PatchOptics> optics;  ///< [2 * material + side], by column
    LineTriangles drawn;
    std::vector<double> region_areas;  ///< true ones, without sensors
    std::vector<std::uint32_t> region_of_patch;
    /// By level of a triangle, and part: the part of the level above that holds it.
    std::vector<std::vector<std::uint32_t>> parents;
    double area = 0;         ///< total area of surfaces
    double mean_albedo = 0;  ///< by area, in the column where it is largest

    [[nodiscard]] const PatchOptics& of(std::uint32_t material, SurfaceSide side) const {
        return optics[std::size_t{2} * material + index_of(side)];
    }
    /// The triangle whose patches represent a triangle and its periodic images.
    [[nodiscard]] std::uint32_t representative(std::uint32_t triangle) const {
        return representatives.empty() ? triangle : representatives[triangle];
    }
    std::vector<std::uint32_t> representatives;  ///< by triangle; empty: each its own
};

}  // namespace quasimc

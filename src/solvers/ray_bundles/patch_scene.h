#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "raster/line_hits.h"
#include "raster/patches.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// What a side of a material sends on, per band.
struct PatchOptics {
    std::vector<double> reflected, transmitted;
};

/// How finely light that leaves surfaces is told apart: by triangle of the caster's mesh, patches
/// of about equal areas (solvers/ray_bundles/patch_size.h), at least four a triangle, and cut where
/// surfaces cross. Images of triangles have none.
/// @param most  about so many patches, unless that loses the shadows of organs
/// @throws InputError  if looking for what crosses would take too long
/// @throws StopRequested  if a stop was requested
[[nodiscard]] Patches make_patches(
    const PreparedScene& prepared,
    std::span<const VisibilityRole> roles,
    double most,
    const std::stop_token& stop);

/// What the matt surfaces of a scene are made of, patch by patch: const, shared by all threads.
struct PatchScene {
    /// @param projected  the scene as beams see it
    PatchScene(const PreparedScene& scene, const ProjectedScene& projected, Patches cut);

    /// A triangle that has patches.
    struct Surface {
        std::uint32_t triangle = 0, region = 0, material = 0;
        double area = 0;  ///< local units squared
        /// Light on it over light on its rounded corners: 1 but for thin triangles.
        double exact_share = 1;
        bool is_sensor = false;
    };

    const PreparedScene& prepared;
    const ProjectedScene& seen;
    Patches patches;
    std::vector<Surface> surfaces;
    std::vector<PatchOptics> optics;  ///< [2 * material + side]
    LineTriangles drawn;
    std::vector<double> region_areas;  ///< true ones, without sensors
    std::vector<std::uint32_t> region_of_patch;
    std::vector<std::vector<std::uint32_t>> parents;  ///< TriangleParts::parent by level and part
    double area = 0;                                  ///< of all surfaces
    double mean_albedo = 0;                           ///< by area, in the band where it is largest

    [[nodiscard]] const PatchOptics& of(std::uint32_t material, SurfaceSide side) const {
        return optics[std::size_t{2} * material + index_of(side)];
    }
    /// The first of a triangle in Patches of the representative of images.
    [[nodiscard]] std::uint32_t representative(std::uint32_t triangle) const {
        return representatives.empty() ? triangle : representatives[triangle];
    }
    std::vector<std::uint32_t> representatives;  ///< of images, by triangle; empty: itself
};

}  // namespace quasimc

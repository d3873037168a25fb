#pragma once

#include <cstdint>
#include <vector>

#include "solvers/ray_bundles/patch_scene.h"

namespace quasimc {

/// A line from a side of a patch to a surface that is near: within some lengths of the patch.
struct NearLine {
    std::uint32_t from = 0;  ///< 2 * patch + side
    std::uint32_t to = 0;    ///< 2 * region + side
    float weight = 0;        ///< flux along it from an exitance of 1
};

/// Surfaces within this distance of the patches of a triangle are near.
[[nodiscard]] double near_distance(const PatchScene& scene, std::uint32_t triangle);

/// Near surfaces of all patches, found once along lines in fixed directions.
struct NearLines {
    explicit NearLines(const PatchScene& scene);

    std::vector<NearLine> lines;
    /// By patch: the number of a group of up to 16, whose members have the same near surfaces even
    /// if lines of few of them meet these; below the number of patches.
    std::vector<std::uint32_t> groups;
};

}  // namespace quasimc

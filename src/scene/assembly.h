#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scene/scene_draft.h"

namespace quasimc {

/// Smallest number of copies for which a mesh is stored once as instances (OrganPart::shared).
/// Fewer copies are stored as triangles, which is faster to trace.
inline constexpr std::size_t kMinCopies = 3;
inline constexpr std::size_t kSmallestPrototype = 64;

/// Organs, regions and triangles of a scene.
struct DraftAssembly {
    std::vector<Organ> organs;
    std::vector<Region> regions;
    std::vector<RegionIndex> triangle_regions, instance_regions;
    Mesh mesh;
    std::vector<Instance> instances;
};

/// Puts the parts of organs together by material.
/// @param draft      checked, its triangles z up
/// @param materials  by material name of the draft
[[nodiscard]] DraftAssembly assemble(SceneDraft draft, std::span<const MaterialId> materials);

}  // namespace quasimc

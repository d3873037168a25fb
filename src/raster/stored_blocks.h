#pragma once

#include <cstdint>
#include <vector>

#include "raster/triangle_block.h"

namespace quasimc {

/// A TriangleBlock of half the size: coordinates as in a mesh.
struct alignas(32) StoredBlock {
    float at[3][3][kBlockLanes];
};

/// The opaque triangles of a scene in blocks, for beams of many directions: they are read
/// sequentially, not corner by corner. Empty where they would take too much memory or are not in
/// single precision (instances).
[[nodiscard]] std::vector<StoredBlock> stored_blocks(const ProjectedScene& scene);

/// The triangles from `first` on, from stored blocks if there are any. Lanes of other than opaque
/// triangles are 0. @param first  a multiple of kBlockLanes
[[nodiscard]] TriangleBlock block_of(const ProjectedScene& scene, std::uint32_t first);

}  // namespace quasimc

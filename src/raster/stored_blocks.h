#pragma once

#include <cstdint>
#include <vector>

#include "raster/triangle_block.h"

namespace quasimc {

/// A TriangleBlock in half the room: coordinates as a mesh has them.
struct alignas(32) StoredBlock {
    float at[3][3][kBlockLanes];
};

/// The triangles of a scene that hide something, in blocks, for beams of many directions: they are
/// read one after the other, not corner by corner. None where they would take too much room, are
/// not in single precision (instances) or are drawn one by one (periodic scenes).
[[nodiscard]] std::vector<StoredBlock> stored_blocks(const ProjectedScene& scene);

/// Triangles `first`, ... of a scene, of those of its blocks if it has any. Lanes of what hides
/// nothing are left at 0. @param first  a multiple of kBlockLanes
[[nodiscard]] TriangleBlock block_of(const ProjectedScene& scene, std::uint32_t first);

}  // namespace quasimc

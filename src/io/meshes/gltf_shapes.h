#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "io/meshes/gltf_buffers.h"
#include "io/meshes/gltf_document.h"
#include "io/meshes/placed_triangles.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// Makes triangles of the accessors of primitives.
class GltfShapes {
  public:
    GltfShapes(GltfBuffers& buffers, Reporter& reporter) : buffers_(buffers), values_(reporter) {}

    /// Nothing after a fault. @param primitive  with triangles
    std::optional<LocalTriangles> triangles(const GltfPrimitive& primitive);

  private:
    std::optional<std::vector<Vec3>> read_points(std::size_t accessor);
    std::optional<std::vector<std::uint32_t>> read_indices(std::size_t accessor, std::size_t count);

    GltfBuffers& buffers_;
    GltfValues values_;
};

}  // namespace quasimc

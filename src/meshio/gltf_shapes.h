#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "meshio/gltf_buffers.h"
#include "meshio/gltf_document.h"
#include "meshio/placed_triangles.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// Makes triangles from the accessors of primitives.
class GltfShapes {
  public:
    GltfShapes(GltfBuffers& buffers, Reporter& reporter)
        : buffers_(buffers), reporter_(reporter), values_(reporter) {}

    /// The mesh of a primitive; empty after a fault. @param primitive  with triangles
    std::optional<Mesh> triangles(const GltfPrimitive& primitive);
    /// Warns of points outside the bounds in the file, or too coarse.
    void finish();

  private:
    std::optional<std::vector<Vec3>> read_points(std::size_t accessor);
    std::optional<std::vector<std::uint32_t>> read_indices(std::size_t accessor, std::size_t count);

    void check_bounds(
        std::size_t number, const GltfAccessor& accessor, const std::vector<Vec3>& points);

    /// Number of accessors of a kind, and the text for the first.
    struct Notes {
        std::size_t count = 0;
        std::string first;
    };

    GltfBuffers& buffers_;
    Reporter& reporter_;
    GltfValues values_;
    Notes other_bounds_, coarse_;
};

}  // namespace quasimc

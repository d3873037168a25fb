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

/// Makes triangles of the accessors of primitives.
class GltfShapes {
  public:
    GltfShapes(GltfBuffers& buffers, Reporter& reporter)
        : buffers_(buffers), reporter_(reporter), values_(reporter) {}

    /// Nothing after a fault. @param primitive  with triangles
    std::optional<Mesh> triangles(const GltfPrimitive& primitive);
    /// Warns of points that are not within the bounds that the file states, or too coarse.
    void finish();

  private:
    std::optional<std::vector<Vec3>> read_points(std::size_t accessor);
    std::optional<std::vector<std::uint32_t>> read_indices(std::size_t accessor, std::size_t count);

    void check_bounds(
        std::size_t number, const GltfAccessor& accessor, const std::vector<Vec3>& points);

    /// How many accessors are of a kind, and what is said of the first.
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

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "meshio/formats.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// Puts meshes of a file, moved, among its vertices.
class PlacedTriangles {
  public:
    PlacedTriangles(MeshFile& file, Reporter& reporter) : file_(file), reporter_(reporter) {}

    /// Adds a part to a group; nothing of a shape without faces. A mirror image keeps the side that
    /// is its front. Faults, once, when the file has too many vertices.
    /// @param line  of each triangle
    void add(
        const Mesh& shape,
        const Affine& transform,
        const std::string& material,
        std::uint32_t line,
        MeshGroup& group);

  private:
    MeshFile& file_;
    Reporter& reporter_;
    bool is_too_large_ = false;
};

/// Takes the ids from all groups, with a warning, if two have the same.
/// @param word  what the file calls a group: "node"
void drop_repeated_ids(MeshFile& file, std::string_view word, Reporter& reporter);

}  // namespace quasimc

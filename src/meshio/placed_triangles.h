#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "meshio/formats.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// Adds transformed meshes to a file.
class PlacedTriangles {
  public:
    PlacedTriangles(MeshFile& file, Reporter& reporter) : file_(file), reporter_(reporter) {}

    /// Adds a part to a group, unless the shape has no faces. Mirror images keep their front side.
    /// Reports once if the file has too many vertices. @param line  for all triangles
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

/// Removes the ids of all groups, with a warning, if two are equal.
/// @param word  the format's word for a group: "node"
void drop_repeated_ids(MeshFile& file, std::string_view word, Reporter& reporter);

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/meshes/formats.h"
#include "quasimc/vec3.h"

namespace quasimc {

/// Triangles in the axes of their mesh.
struct LocalTriangles {
    std::vector<Vec3> points;
    std::vector<Face> faces;
};

/// Puts meshes of a file, moved, among its vertices.
class PlacedTriangles {
  public:
    PlacedTriangles(MeshFile& file, Reporter& reporter) : file_(file), reporter_(reporter) {}

    /// Adds a part to a group; nothing of a shape without faces. A mirror image keeps the side that
    /// is its front. Faults, once, when the file has too many vertices.
    /// @param line  of each triangle
    void add(
        const LocalTriangles& shape,
        const Affine& transform,
        const std::string& material,
        std::uint32_t line,
        MeshGroup& group);

  private:
    MeshFile& file_;
    Reporter& reporter_;
    bool is_too_large_ = false;
};

/// Adds the triangles of a face of 3 to kMostCorners corners.
/// @returns whether its sides cross, so that it became a fan from its first corner
bool add_polygon(
    std::span<const Vec3> corners, std::span<const std::uint32_t> numbers, LocalTriangles& shape);

/// How the corners of triangles follow each other; what is none has no triangles.
enum class CornerOrder { none, triangles, strip, fan };

/// The triangles of corners in an order; of strips and fans those that are but lines are left out.
[[nodiscard]] std::vector<Face> faces_of(
    CornerOrder order, const std::vector<std::uint32_t>& corners);

/// Takes the ids from all groups, with a warning, if two have the same.
/// @param word  what the file calls a group: "node"
void drop_repeated_ids(MeshFile& file, std::string_view word, Reporter& reporter);

/// Adds a label that the group does not have yet, unless it is empty or the group's name.
void add_label(std::string_view key, const std::string& value, MeshGroup& group);

}  // namespace quasimc

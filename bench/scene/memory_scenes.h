#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc::bench {

/// Vertices and faces of a generated scene.
struct Surface {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;

    [[nodiscard]] std::vector<Triangle> triangles() const;
};

/// Separate leaves in the unit cube, without shared vertices.
[[nodiscard]] Surface soup(std::size_t triangles);
/// One wavy sheet: one vertex per two triangles.
[[nodiscard]] Surface sheet(std::size_t triangles);

/// Writes a surface in text (OBJ) or in binary with single precision (PLY).
void write_obj_file(const Surface& surface, const std::string& path);
void write_ply_file(const Surface& surface, const std::string& path);

}  // namespace quasimc::bench

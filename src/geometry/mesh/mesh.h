#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "base/vec3.h"
#include "geometry/mesh/triangle.h"

namespace quasimc {

/// The numbers of a triangle's three vertices, in the order of its corners.
using Face = std::array<std::uint32_t, 3>;

/// Triangles that may share vertices. Triangles without neighbours are a mesh too.
struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Face> faces;  ///< every number is less than the number of vertices

    Mesh() = default;
    Mesh(std::vector<Vec3> all_vertices, std::vector<Face> all_faces);
    /// The same triangles in the same order, as by push_back().
    Mesh(const std::vector<Triangle>& triangles);  // NOLINT(google-explicit-constructor)
    Mesh(std::initializer_list<Triangle> triangles);

    [[nodiscard]] std::size_t size() const { return faces.size(); }
    [[nodiscard]] bool empty() const { return faces.empty(); }
    /// The corners of triangle `i`.
    [[nodiscard]] Triangle operator[](std::size_t i) const {
        const Face& f = faces[i];
        return {vertices[f[0]], vertices[f[1]], vertices[f[2]]};
    }
    /// Adds a triangle. Corners with all the digits of a corner of the triangle before are not
    /// stored again.
    void push_back(const Triangle& triangle);
    /// Adds the triangles of another mesh; their vertices are stored again.
    void append(const Mesh& other);

    friend bool operator==(const Mesh&, const Mesh&) = default;
};

[[nodiscard]] double area(const Mesh& mesh);

/// Renumbers the vertices in the order in which the faces name them first; those that no face names
/// are left out.
void order_vertices(Mesh& mesh);

}  // namespace quasimc

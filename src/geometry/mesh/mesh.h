#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "base/frozen_array.h"
#include "quasimc/mesh.h"
#include "quasimc/vec3.h"

namespace quasimc {

/// A mesh that changes no more. Copies share its arrays.
struct FrozenMesh {
    FrozenArray<Vec3> vertices;
    FrozenArray<Face> faces;  ///< every number is less than the number of vertices

    FrozenMesh() = default;
    FrozenMesh(FrozenArray<Vec3> all_vertices, FrozenArray<Face> all_faces)
        : vertices(std::move(all_vertices)), faces(std::move(all_faces)) {}
    explicit FrozenMesh(Mesh mesh) : FrozenMesh(std::move(mesh.vertices), std::move(mesh.faces)) {}
    /// The arrays of `mesh` itself.
    explicit FrozenMesh(const std::shared_ptr<const Mesh>& mesh)
        : vertices(mesh, mesh->vertices), faces(mesh, mesh->faces) {}

    [[nodiscard]] std::size_t size() const { return faces.size(); }
    [[nodiscard]] bool empty() const { return faces.empty(); }
    /// The corners of triangle `i`.
    [[nodiscard]] Triangle operator[](std::size_t i) const {
        const auto& [a, b, c] = faces[i];
        return {vertices[a], vertices[b], vertices[c]};
    }
    friend bool operator==(const FrozenMesh&, const FrozenMesh&) = default;
};

[[nodiscard]] double area(const FrozenMesh& mesh);

/// Renumbers the vertices in the order in which the faces name them first; those that no face names
/// are left out.
void order_vertices(Mesh& mesh);

}  // namespace quasimc

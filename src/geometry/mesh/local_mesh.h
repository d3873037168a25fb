#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/vec3.h"
#include "geometry/mesh/cell.h"
#include "geometry/mesh/mesh.h"
#include "geometry/range_index.h"
#include "geometry/scene_geometry.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// Vertices for Embree: three floats each, and padding at the end that it may read.
inline constexpr std::size_t kVertexPadding = 4;

/// A mesh with several copies in the scene, in single precision about its own centre.
struct LocalPrototype {
    std::vector<float> vertices;  ///< 3 numbers per vertex, plus kVertexPadding
    std::shared_ptr<const Mesh> mesh;
    std::vector<Vec3> outline;  ///< vertices whose convex hull is the mesh's
};

/// A copy of a prototype.
struct LocalInstance {
    std::uint32_t prototype = 0;
    /// Columns x, y, z and shift of the map from the prototype's coordinates to local ones.
    std::array<float, 12> matrix{};

    [[nodiscard]] Vec3 point(const Vec3& p) const {
        const auto row = [&](std::size_t i) {
            return double{matrix[i]} * p.x + double{matrix[i + 3]} * p.y +
                   double{matrix[i + 6]} * p.z + double{matrix[i + 9]};
        };
        return {row(0), row(1), row(2)};
    }
};

/// Triangles in the coordinates of the intersectors: single precision about a local origin, scaled
/// by a power of two so that every coordinate lies in [-1, 1]. Neither the unit of length nor the
/// distance from the world's origin affects the precision.
///
/// "Local coordinates" below and in the intersectors are (world - origin) * scale.
///
/// Triangles are numbered as in SceneGeometry: those of one mesh, then those of the instances.
struct LocalMesh {
    Vec3 origin;
    double scale = 1;             ///< a power of two
    std::vector<float> vertices;  ///< 3 numbers per vertex, plus kVertexPadding
    std::span<const Face> faces;
    std::shared_ptr<const void> owner_of_faces;

    std::vector<LocalPrototype> prototypes;
    std::vector<LocalInstance> instances;
    RangeIndex ranges;  ///< the triangles of each instance

    [[nodiscard]] std::uint32_t triangle_count() const {
        return static_cast<std::uint32_t>(faces.size()) + instance_triangles;
    }
    [[nodiscard]] Vec3 vertex(std::uint32_t triangle, int corner) const {
        if (triangle >= faces.size()) [[unlikely]] {
            return instance_vertex(triangle, corner);
        }
        return own_vertex(faces[triangle][static_cast<std::size_t>(corner)]);
    }
    /// The point v0 + u (v1 - v0) + v (v2 - v0) of a triangle, local coordinates.
    [[nodiscard]] Vec3 point(std::uint32_t triangle, double u, double v) const {
        const Vec3 p = vertex(triangle, 0);
        return p + u * (vertex(triangle, 1) - p) + v * (vertex(triangle, 2) - p);
    }
    /// A normal of a triangle on its upper side, with twice its area as length.
    [[nodiscard]] Vec3 across(std::uint32_t triangle) const {
        const Vec3 p = vertex(triangle, 0);
        return cross(vertex(triangle, 1) - p, vertex(triangle, 2) - p);
    }
    /// Ratio of the light along `direction` on a triangle to that on its rounded corners: 1 except
    /// for `thin` ones.
    [[nodiscard]] double exact_share(std::uint32_t triangle, const Vec3& direction) const {
        return thin.empty() ? 1 : share_of_thin(triangle, direction);
    }
    /// Ratio of the area of a triangle to that of its rounded corners: 1 except for `thin` ones.
    [[nodiscard]] double exact_area_share(std::uint32_t triangle) const {
        return thin.empty() ? 1 : area_share_of_thin(triangle);
    }
    /// across() of the triangle before rounding.
    [[nodiscard]] Vec3 exact_across(std::uint32_t triangle) const;
    [[nodiscard]] Vec3 to_local(const Vec3& world) const { return scale * (world - origin); }
    [[nodiscard]] Vec3 to_world(const Vec3& local) const { return origin + local / scale; }

    /// Number of vertices without an instance, and one of them.
    [[nodiscard]] std::size_t vertex_count() const {
        return vertices.empty() ? 0 : (vertices.size() - kVertexPadding) / 3;
    }
    [[nodiscard]] Vec3 own_vertex(std::size_t i) const {
        const float* v = &vertices[3 * i];
        return {v[0], v[1], v[2]};
    }
    /// Copies the faces, so that the scene need not be retained.
    void copy_faces() {
        const auto own = std::make_shared<const std::vector<Face>>(faces.begin(), faces.end());
        faces = *own;
        owner_of_faces = own;
    }
    std::uint32_t instance_triangles = 0;  ///< of all instances together
    /// Triangles without an instance whose area rounding changes by more than a thousandth, and
    /// their exact across().
    std::unordered_map<std::uint32_t, Vec3> thin;
    /// Largest relative change of across() by rounding of any other triangle without an instance.
    double most_turned = 0;
    bool has_slivers = false;  ///< whether is_sliver() holds for any triangle without an instance
    Bounds bounds;             ///< of the triangles, local coordinates

  private:
    [[nodiscard]] double share_of_thin(std::uint32_t triangle, const Vec3& direction) const;
    [[nodiscard]] double area_share_of_thin(std::uint32_t triangle) const;
    [[nodiscard]] Vec3 instance_vertex(std::uint32_t triangle, int corner) const;
};

/// The scale of local coordinates for a scene with these bounds.
[[nodiscard]] double local_scale(const Bounds& bounds);

/// The local mesh of `triangles` about the centre of their bounds; at least one triangle, all
/// finite.
[[nodiscard]] LocalMesh make_local_mesh(const std::vector<Triangle>& triangles);
/// The local mesh of a scene, whose faces it shares.
[[nodiscard]] LocalMesh make_local_mesh(const std::shared_ptr<const SceneGeometry>& geometry);

/// A cell in the local coordinates of a mesh.
[[nodiscard]] Cell local_cell(const LocalMesh& mesh, const Cell& world);

/// Calls visit(p) for points p, local coordinates, with the convex hull of the mesh.
template <typename Visit>
void for_each_outer_vertex(const LocalMesh& mesh, const Visit& visit) {
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        visit(mesh.own_vertex(i));
    }
    for (const LocalInstance& instance : mesh.instances) {
        for (const Vec3& p : mesh.prototypes[instance.prototype].outline) {
            visit(instance.point(p));
        }
    }
}

/// The vertices that may be corners of the mesh's convex hull, see outline_points().
[[nodiscard]] std::vector<Vec3> outline_points(const LocalMesh& mesh);

}  // namespace quasimc

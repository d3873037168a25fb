#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "geometry/mesh/triangle.h"

namespace quasimc {

/// Triangles as the ray engine sees them: single precision about a local origin, scaled by a power
/// of two so that every coordinate lies in [-1, 1]. Neither the unit of length nor the distance
/// from the world's origin changes the digits that are traced.
///
/// "Local coordinates" below and in the intersectors are (world - origin) * scale.
struct LocalMesh {
    Vec3 origin;
    double scale = 1;             ///< a power of two
    std::vector<float> vertices;  ///< 9 numbers a triangle, and 4 of padding at the end

    [[nodiscard]] std::uint32_t triangle_count() const {
        return static_cast<std::uint32_t>(vertices.size() / 9);
    }
    [[nodiscard]] Vec3 vertex(std::uint32_t triangle, int corner) const {
        const float* v =
            &vertices[std::size_t{9} * triangle + 3 * static_cast<std::size_t>(corner)];
        return {v[0], v[1], v[2]};
    }
    /// The point v0 + u (v1 - v0) + v (v2 - v0) of a triangle, local coordinates.
    [[nodiscard]] Vec3 point(std::uint32_t triangle, double u, double v) const {
        const Vec3 p = vertex(triangle, 0);
        return p + u * (vertex(triangle, 1) - p) + v * (vertex(triangle, 2) - p);
    }
    /// A vector across the triangle on its upper side, as long as twice its area.
    [[nodiscard]] Vec3 across(std::uint32_t triangle) const {
        const Vec3 p = vertex(triangle, 0);
        return cross(vertex(triangle, 1) - p, vertex(triangle, 2) - p);
    }
    [[nodiscard]] Vec3 to_local(const Vec3& world) const { return scale * (world - origin); }
    [[nodiscard]] Vec3 to_world(const Vec3& local) const { return origin + local / scale; }
};

/// The local mesh of `triangles` about the center of their bounds; at least one triangle, all
/// finite.
[[nodiscard]] LocalMesh make_local_mesh(const std::vector<Triangle>& triangles);

}  // namespace quasimc

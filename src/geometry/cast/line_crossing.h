#pragma once

#include <limits>

#include "base/vec3.h"
#include "geometry/cast/intersector.h"
#include "geometry/mesh/local_mesh.h"

namespace quasimc {

/// A triangle as its first corner and the edges from there to the others.
struct CornerAndEdges {
    Vec3 corner, edge1, edge2;
};

inline CornerAndEdges corner_and_edges(const LocalMesh& mesh, std::uint32_t triangle) {
    const Vec3 corner = mesh.vertex(triangle, 0);
    return {corner, mesh.vertex(triangle, 1) - corner, mesh.vertex(triangle, 2) - corner};
}

/// Intersection of a ray's line with the plane of a triangle.
struct LineCrossing {
    double t = std::numeric_limits<double>::quiet_NaN(), u = 0, v = 0;
    bool is_inside = false;  ///< of the triangle, including its border
};

/// Moeller and Trumbore 1997, in double precision. A line parallel to the plane has no
/// intersection.
inline LineCrossing cross_plane(const CornerAndEdges& triangle, const Ray& ray) {
    const Vec3 p = cross(ray.direction, triangle.edge2);
    const double determinant = dot(triangle.edge1, p);
    if (determinant == 0) {
        return {};
    }
    const Vec3 from_corner = ray.origin - triangle.corner;
    const double u = dot(from_corner, p) / determinant;
    const Vec3 q = cross(from_corner, triangle.edge1);
    const double v = dot(ray.direction, q) / determinant;
    const double t = dot(triangle.edge2, q) / determinant;
    return {t, u, v, u >= 0 && v >= 0 && u + v <= 1};
}

}  // namespace quasimc

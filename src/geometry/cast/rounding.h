#pragma once

#include "base/vec3.h"
#include "geometry/cast/intersector.h"
#include "geometry/mesh/local_mesh.h"

namespace quasimc {

/// Hits closer than this, in local units, do not count: the origin of a ray is rounded to single
/// precision.
inline constexpr float kNear = 0x1p-22F;

/// Surfaces closer to a lamp than this, in local units, are tested from the lamp: seen from
/// elsewhere at a small angle, a surface in whose plane the lamp lies may appear to occlude it.
inline constexpr float kTouch = 0x1p-14F;

/// Hits closer than this are checked in double precision. A ray that starts in a triangle's plane
/// and leaves it at a small angle may hit it only because its origin is a rounding error behind it.
inline constexpr float kDoubtful = 0x1p-10F;

/// Whether the hit at `t` on `triangle` is due to rounding: in double precision the ray meets the
/// triangle's plane no further than ray.near.
inline bool is_rounding(const LocalMesh& mesh, const Ray& ray, std::uint32_t triangle, float t) {
    if (t > kDoubtful) {
        return false;
    }
    const Vec3 corner = mesh.vertex(triangle, 0);
    const Vec3 normal = cross(mesh.vertex(triangle, 1) - corner, mesh.vertex(triangle, 2) - corner);
    const double exact = dot(corner - ray.origin, normal) / dot(ray.direction, normal);
    return !(exact > ray.near);
}

}  // namespace quasimc

#pragma once

#include "quasimc/mesh.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// The surface at the point where a ray hit the scene. Local coordinates.
struct Surface {
    std::uint32_t triangle = kNoTriangle;  ///< index in the mesh
    std::uint32_t region = 0;
    SurfaceSide side = SurfaceSide::upper;  ///< hit by the ray
    Vec3 normal;                            ///< unit, of that side
    double cosine = 1;                      ///< between that normal and the reversed ray, >= 0
};

/// The surface that a ray along `direction` met.
inline Surface surface_at(const PreparedScene& prepared, const Hit& hit, const Vec3& direction) {
    const Vec3 up{hit.normal[0], hit.normal[1], hit.normal[2]};
    const double along = dot(up, direction);
    const double scale = (along < 0 ? 1 : -1) / length(up);
    return {
        hit.triangle, prepared.region(hit.triangle), side_facing(along), scale * up,
        std::abs(along * scale)};
}

/// The point of a hit from its barycentric coordinates, on the triangle to the last digit.
inline Vec3 point_of(const PreparedScene& prepared, const Hit& hit) {
    return prepared.caster().mesh().point(hit.triangle, hit.u, hit.v);
}

}  // namespace quasimc

#include "geometry/cast/sliver_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/mesh/point2.h"
#include "geometry/mesh/sliver.h"

namespace quasimc {

namespace {

/// The place of a triangle's border that is nearest to `offset` from the first corner, as u and v.
Point2 nearest_on_border(const Vec3& edge1, const Vec3& edge2, const Vec3& offset) {
    constexpr std::array<Point2, 3> kCorners{{{0, 0}, {1, 0}, {0, 1}}};
    const std::array<Vec3, 3> corners{{{0, 0, 0}, edge1, edge2}};
    Point2 best{};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        const Vec3 side = corners[next] - corners[i];
        const double square = dot(side, side);
        const double along = dot(offset - corners[i], side);
        const double part = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
        const Vec3 off = corners[i] + part * side - offset;
        if (dot(off, off) < least) {
            least = dot(off, off);
            best = {
                kCorners[i].s + part * (kCorners[next].s - kCorners[i].s),
                kCorners[i].t + part * (kCorners[next].t - kCorners[i].t)};
        }
    }
    return best;
}

}  // namespace

Hit placed_on_sliver(const LocalMesh& mesh, const Ray& ray, const Hit& hit) {
    if (!hit.found()) {
        return hit;
    }
    const Vec3 corner = mesh.vertex(hit.triangle, 0);
    const Vec3 edge1 = mesh.vertex(hit.triangle, 1) - corner;
    const Vec3 edge2 = mesh.vertex(hit.triangle, 2) - corner;
    if (!is_sliver(edge1, edge2)) {
        return hit;
    }
    const Vec3 p = cross(ray.direction, edge2);
    const double determinant = dot(edge1, p);
    const Vec3 from_corner = ray.origin - corner;
    const Vec3 q = cross(from_corner, edge1);
    const double t = dot(edge2, q) / determinant;
    Point2 place{dot(from_corner, p) / determinant, dot(ray.direction, q) / determinant};
    // A ray in the plane, as near as can be told, is left where the engine has it.
    constexpr double kApart = 0x1p-10;
    if (!(std::abs(t - hit.t) < kApart)) {
        return hit;
    }
    if (place.s < 0 || place.t < 0 || place.s + place.t > 1) {
        place = nearest_on_border(edge1, edge2, from_corner + t * ray.direction);
    }
    Hit placed = hit;
    placed.u = static_cast<float>(place.s);
    placed.v = static_cast<float>(place.t);
    return placed;
}

}  // namespace quasimc

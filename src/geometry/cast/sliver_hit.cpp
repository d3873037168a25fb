#include "geometry/cast/sliver_hit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/cast/line_crossing.h"
#include "geometry/mesh/point2.h"
#include "geometry/mesh/sliver.h"

namespace quasimc {

namespace {

/// The point of a triangle's border closest to `offset` from the first corner, as u and v.
Point2 nearest_on_border(const CornerAndEdges& triangle, const Vec3& offset) {
    constexpr std::array<Point2, 3> kCorners{{{0, 0}, {1, 0}, {0, 1}}};
    const std::array<Vec3, 3> corners{{{0, 0, 0}, triangle.edge1, triangle.edge2}};
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

Hit snapped_to_sliver(const LocalMesh& mesh, const Ray& ray, const Hit& hit) {
    const CornerAndEdges triangle = corner_and_edges(mesh, hit.triangle);
    if (!is_sliver(triangle.edge1, triangle.edge2)) {
        return hit;
    }
    const LineCrossing at = cross_plane(triangle, ray);
    // The hit of a ray within the plane is not changed.
    constexpr double kApart = 0x1p-10;
    if (!(std::abs(at.t - hit.t) < kApart)) {
        return hit;
    }
    Point2 point{at.u, at.v};
    if (!at.is_inside) {
        point = nearest_on_border(triangle, ray.origin - triangle.corner + at.t * ray.direction);
    }
    Hit placed = hit;
    placed.u = static_cast<float>(point.s);
    placed.v = static_cast<float>(point.t);
    return placed;
}

}  // namespace quasimc

#include "solvers/direct/line_cost.h"

#include <algorithm>
#include <cmath>

namespace quasimc {
namespace {

Vec3 absolute(const Vec3& v) {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

Vec3 extent_of(const LocalMesh& mesh, std::uint32_t triangle) {
    const Vec3 a = mesh.vertex(triangle, 0);
    const Vec3 b = mesh.vertex(triangle, 1);
    const Vec3 c = mesh.vertex(triangle, 2);
    const auto range = [](double p, double q, double r) {
        return std::max({p, q, r}) - std::min({p, q, r});
    };
    return {range(a.x, b.x, c.x), range(a.y, b.y, c.y), range(a.z, b.z, c.z)};
}

}  // namespace

LineCost::LineCost(const ProjectedScene& scene) : scene_(scene) {
    if (!scene.cell.periodic()) {
        return;
    }
    for (std::uint32_t i = 0; i < scene.mesh->triangle_count(); ++i) {
        if (scene.role(i) != VisibilityRole::omitted) {
            extents_ += extent_of(*scene.mesh, i);
            areas_ += 0.5 * absolute(scene.mesh->across(i));
        }
    }
}

/// A line is one period long and represents all values of t. A triangle that reaches over a part f
/// of the period of t is cut by f lines in each, once and once more for every period along s that
/// its width there reaches into; the widths of all lines add up to the area of its projection.
double LineCost::cuts_per_line(const Vec3& direction) const {
    if (!scene_.cell.periodic()) {
        return 0;
    }
    const ProjectionPlane plane(scene_, direction, 0, AlongPeriods::slanted);
    const double along_t = dot(absolute(plane.t), extents_) / plane.size_t;
    const double projection = dot(absolute(direction), areas_) / plane.area;
    return along_t + projection / (plane.size_s * plane.size_t);
}

}  // namespace quasimc

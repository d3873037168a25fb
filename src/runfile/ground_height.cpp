#include "runfile/ground_height.h"

#include <algorithm>
#include <array>

#include "geometry/mesh/mesh.h"

namespace quasimc {
namespace {

/// The height of a triangle at (x, y), by barycentric coordinates seen from above; empty beside it
/// and for a vertical triangle.
std::optional<double> height_of_triangle(const Triangle& t, double x, double y) {
    const auto cross_z = [](const Vec3& a, const Vec3& b) { return a.x * b.y - a.y * b.x; };
    const Vec3 p{x, y, 0};
    const double area = cross_z(t[1] - t[0], t[2] - t[0]);
    const std::array<double, 3> weights{
        cross_z(t[1] - p, t[2] - p), cross_z(t[2] - p, t[0] - p), cross_z(t[0] - p, t[1] - p)};
    const auto [low, high] = std::minmax_element(weights.begin(), weights.end());
    const bool is_within = area > 0 ? *low >= 0 : *high <= 0;
    if (area == 0 || !is_within) {
        return std::nullopt;
    }
    return (weights[0] * t[0].z + weights[1] * t[1].z + weights[2] * t[2].z) / area;
}

}  // namespace

std::optional<double> ground_height(
    const GroundSpec& ground, const Orientation& orientation, double x, double y) {
    if (ground.triangles.empty()) {
        return ground.height;
    }
    std::optional<double> highest;
    for (std::size_t i = 0; i < ground.triangles.size(); ++i) {
        Triangle triangle = ground.triangles[i];
        for (Vec3& corner : triangle) {
            corner = orientation.inward(corner);
        }
        if (const auto height = height_of_triangle(triangle, x, y)) {
            highest = std::max(highest.value_or(*height), *height);
        }
    }
    return highest;
}

}  // namespace quasimc

#include "solvers/from_organs/light_vertices.h"

#include <algorithm>
#include <cmath>

#include "solvers/direct/visibility.h"

namespace quasimc {

VertexLight::Connection VertexLight::connect(
    const LightVertex& vertex,
    std::span<const double> weights,
    const Vec3& p,
    std::uint32_t triangle,
    double min_distance,
    std::span<double> irradiance) const {
    const Vec3 way = p - vertex.p;
    const double square = dot(way, way);
    if (square == 0 || square < min_distance * min_distance ||
        triangle == vertex.surface.triangle) {
        return {};
    }
    const double distance = std::sqrt(square);
    const Vec3 wi = way / distance;
    const Side& side = prepared_.material(vertex.surface.region).side(vertex.surface.side);
    std::fill(irradiance.begin(), irradiance.end(), 0.0);
    side.add_scattered(vertex.surface.normal, vertex.wi, wi, narrow_from_, weights, irradiance);
    const auto is_none = [](double x) { return x == 0; };
    if (std::all_of(irradiance.begin(), irradiance.end(), is_none)) {
        return {};
    }
    const double scale = scale_ / (square * prepared_.projection().world_area());
    for (double& x : irradiance) {
        x *= scale;
    }
    const bool arrives =
        is_visible_point(prepared_, p, -wi, distance, triangle, vertex.surface.triangle);
    return {wi, true, arrives};
}

}  // namespace quasimc

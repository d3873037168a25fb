#include "transport/light_vertices.h"

#include <algorithm>
#include <cmath>

namespace quasimc {

VertexLight::Arrival VertexLight::find(
    const LightVertex& vertex,
    std::span<const double> weights,
    const Vec3& place,
    std::uint32_t triangle,
    double leg,
    std::span<double> irradiance) const {
    const Vec3 way = place - vertex.place;
    const double square = dot(way, way);
    if (square == 0 || square < leg * leg || triangle == vertex.surface.triangle) {
        return {};
    }
    const double distance = std::sqrt(square);
    const Vec3 wi = way / distance;
    const Side& side = prepared_.material(vertex.surface.region).side(vertex.surface.side);
    std::fill(irradiance.begin(), irradiance.end(), 0.0);
    side.add_scattered(vertex.surface.normal, vertex.wi, wi, sharp_from_, weights, irradiance);
    const auto is_none = [](double x) { return x == 0; };
    if (std::all_of(irradiance.begin(), irradiance.end(), is_none)) {
        return {};
    }
    const double scale = scale_ / (square * prepared_.world_area());
    for (double& x : irradiance) {
        x *= scale;
    }
    return {wi, true, prepared_.connects(place, -wi, distance, triangle, vertex.surface.triangle)};
}

}  // namespace quasimc

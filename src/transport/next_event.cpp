#include "transport/next_event.h"

#include <algorithm>

#include "base/distribution.h"

namespace quasimc {

NextEvent::NextEvent(const PreparedScene& prepared, const Sampler& sampler, double scale)
    : prepared_(prepared), sampler_(sampler), scale_(scale) {
    const auto& lights = prepared.lights();
    dimensions_ = lights.size() == 1 && lights[0].source->is_directional() ? 0 : 2;
}

Sight NextEvent::look(
    const Stream& stream, std::uint64_t point, std::uint32_t dimension, const Vec3& place) const {
    double u0 = 0;
    double u1 = 0;
    if (dimensions_ > 0) {
        u0 = sampler_.coordinate(stream, point, dimension);
        u1 = sampler_.coordinate(stream, point, dimension + 1);
    }
    const BoundSource& light = prepared_.lights()[prepared_.pick_light(u0)];
    u0 = std::clamp((u0 - light.before) / light.probability, 0.0, kBelowOne);
    const Illumination seen = light.source->illuminate(prepared_.to_world(place), u0, u1);
    return {
        &light, seen.to_light, seen.weight * scale_of(light),
        seen.distance * prepared_.caster().mesh().scale};
}

std::uint64_t NextEvent::add_light(
    const Sight& sight,
    const Surface& surface,
    const Vec3& place,
    const Vec3& out,
    GatherScratch& path) const {
    const bool is_same_side = dot(sight.to_light, surface.normal) > 0;
    const SurfaceSide arrival = is_same_side ? surface.side : opposite(surface.side);
    const Material& material = prepared_.material(surface.region);
    if (material.side(arrival).lobes().empty() || sight.factor == 0 ||
        !prepared_.reaches(place, sight.to_light, sight.distance, surface.triangle)) {
        return 0;
    }
    for (std::size_t b = 0; b < path.weights.size(); ++b) {
        path.products[b] = path.weights[b] * sight.light->start_weights[b];
    }
    material.add_reflected(
        surface.normal, surface.side, out, -sight.to_light, sight.factor, path.products,
        path.gathered);
    return 1;
}

void NextEvent::add_sky(const Vec3& to_light, GatherScratch& path) const {
    for (const BoundSource& light : prepared_.lights()) {
        const double radiance =
            light.is_extended() ? light.source->radiance(to_light) * light.probability : 0;
        for (std::size_t b = 0; radiance > 0 && b < path.weights.size(); ++b) {
            path.gathered[b] +=
                path.weights[b] * light.start_weights[b] * radiance * scale_of(light);
        }
    }
}

}  // namespace quasimc

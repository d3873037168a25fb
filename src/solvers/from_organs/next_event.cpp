#include "solvers/from_organs/next_event.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/distribution.h"
#include "light/models/hemisphere.h"
#include "light/models/source.h"
#include "solvers/direct/visibility.h"

namespace quasimc {

NextEvent::NextEvent(
    const PreparedScene& prepared,
    const Sampler& sampler,
    const LampNearField& near,
    double scale,
    double narrow_from,
    std::uint64_t points)
    : prepared_(prepared),
      sampler_(sampler),
      near_(near),
      scale_(scale),
      narrow_from_(narrow_from),
      light_sampler_(prepared, points) {
    const auto& lights = prepared.lights();
    dimensions_ = lights.size() == 1 && lights[0].source->is_directional() ? 0 : 2;
    constexpr std::size_t kMaxEvaluated = 1000;  // lights, all of which are evaluated each time
    const bool has_lamp = std::any_of(lights.begin(), lights.end(), [](const BoundSource& light) {
        return light.source->is_lamp();
    });
    if (has_lamp && lights.size() > 1 && lights.size() <= kMaxEvaluated) {
        for (const BoundSource& light : lights) {
            lamps_.push_back(light.source_sampler->lamp_extent().value_or(LampExtent{}));
        }
    }
}

/// The approximate irradiance of a light at a point without occlusion, mean over the bands; lamps
/// count as isotropic.
double NextEvent::importance(std::size_t index, const Vec3& p) const {
    const BoundSource& light = prepared_.lights()[index];
    const double spectrum = light.probability / light.source_sampler->flux();
    if (!light.source->is_lamp()) {
        return spectrum;
    }
    const BoundingSphere& body = lamps_[index].body;
    constexpr double kNearest = 1e-6;
    const Vec3 offset = p - body.center;
    const double square = std::max(dot(offset, offset), body.radius * body.radius);
    return spectrum /
           (4 * std::numbers::pi * prepared_.projection().world_area() * (square + kNearest));
}

/// Picks lights by flux with a probability of a fifth, so that lights with an underestimated
/// importance are not missed.
NextEvent::Pick NextEvent::pick(double u, const Vec3& p) const {
    const auto& lights = prepared_.lights();
    if (lamps_.empty()) {
        const LightPick share = light_sampler_.pick(u);
        return {&lights[share.index], share.u, share.probability};
    }
    double sum = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        sum += importance(i, p);
    }
    constexpr double kByFlux = 0.2;
    double before = 0;
    for (std::size_t i = 0;; ++i) {
        const double probability =
            kByFlux * lights[i].probability + (1 - kByFlux) * importance(i, p) / sum;
        if (u < before + probability || i + 1 == lights.size()) {
            return {
                &lights[i], std::clamp((u - before) / probability, 0.0, kBelowOne), probability};
        }
        before += probability;
    }
}

namespace {

/// Samples a sky within a narrow field of view. If directions were sampled over all of the sky,
/// nearly every replicate would have the same number in the view, and hide the error.
Illumination sky_within(const Source& sky, const FieldOfView& view, double u0, double u1) {
    const double part = 1 - view.least_cosine * view.least_cosine;  // sine of its edge, squared
    const double edge = std::sqrt(part);
    const bool above = view.normal.z > -edge;  // whether that side sees part of the sky
    const bool below = -view.normal.z > -edge;
    const bool is_upper = above && (!below || u0 < .5);
    const double u = above && below ? 2 * u0 - (is_upper ? 0 : 1) : u0;
    const Vec3 axis = is_upper ? view.normal : -view.normal;
    const Vec3 to_light = cosine_direction_about(axis, part * u, u1);
    const double sides = above && below ? 2 : 1;
    return {
        to_light,
        sides * std::numbers::pi * part * model_of(sky).radiance(to_light) / dot(to_light, axis)};
}

}  // namespace

LightSample NextEvent::sample_light(
    const Stream& stream,
    std::uint64_t point,
    std::uint32_t dimension,
    const Vec3& p,
    const FieldOfView& view) const {
    double u0 = 0;
    double u1 = 0;
    if (dimensions_ > 0) {
        u0 = sampler_.coordinate(stream, point, dimension);
        u1 = sampler_.coordinate(stream, point, dimension + 1);
    }
    return sample_light(u0, u1, p, view);
}

LightSample NextEvent::sample_light(
    double u0, double u1, const Vec3& p, const FieldOfView& view) const {
    const Pick picked = pick(u0, p);
    const BoundSource& light = *picked.light;
    const Illumination seen =
        view.least_cosine > 0 && light.is_extended()
            ? sky_within(*light.source, view, picked.u, u1)
            : model_of(*light.source)
                  .illuminate(prepared_.caster().mesh().to_world(p), picked.u, u1);
    const double rarer = light.probability / picked.probability;
    return {
        &light, seen.to_light, seen.weight * scale_of(light) * rarer,
        seen.distance * prepared_.caster().mesh().scale, picked.probability};
}

bool NextEvent::is_in_plane(const LightSample& sample, const Vec3& normal) {
    // Half a unit in the last digit of either's coordinates, and a margin.
    constexpr double kHeight = 8e-8;
    return std::isfinite(sample.distance) &&
           std::abs(dot(sample.to_light, normal)) * sample.distance < kHeight;
}

std::uint64_t NextEvent::add_light(
    const LightSample& sample,
    const Surface& surface,
    const Vec3& p,
    const Vec3& out,
    GatherScratch& path) const {
    const bool is_same_side = dot(sample.to_light, surface.normal) > 0;
    const SurfaceSide arrival = is_same_side ? surface.side : opposite(surface.side);
    const Material& material = prepared_.material(surface.region);
    if (material.side(arrival).lobes().empty() || sample.factor == 0 ||
        is_in_plane(sample, surface.normal) || near_.scatters_near(*sample.light, p) ||
        !is_visible_source(prepared_, p, sample.to_light, sample.distance, surface.triangle)) {
        return 0;
    }
    for (std::size_t b = 0; b < path.weights.size(); ++b) {
        path.products[b] = path.weights[b] * sample.light->start_weights[b];
    }
    material.add_reflected(
        surface.normal, surface.side, out, -sample.to_light, sample.factor, path.products,
        path.gathered_from(sample.light->origin),
        sample.light->is_extended() ? kNarrowPeak : narrow_from_);
    return 1;
}

void NextEvent::add_sky(const Vec3& to_light, GatherScratch& path) const {
    for (const BoundSource& light : prepared_.lights()) {
        const double radiance = light.is_extended()
                                    ? model_of(*light.source).radiance(to_light) * light.probability
                                    : 0;
        for (std::size_t b = 0; radiance > 0 && b < path.weights.size(); ++b) {
            path.gathered_from(light.origin)[b] +=
                path.weights[b] * light.start_weights[b] * radiance * scale_of(light);
        }
    }
}

}  // namespace quasimc

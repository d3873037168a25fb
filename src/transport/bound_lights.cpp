#include "transport/bound_lights.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/distribution.h"
#include "base/stop.h"

namespace quasimc {
namespace {

/// Per band, the flux of all lights.
std::vector<double> total_flux(
    const std::vector<BoundSource>& lights, double area, std::size_t bands) {
    std::vector<double> flux(bands);
    for (const BoundSource& light : lights) {
        for (std::size_t b = 0; b < bands; ++b) {
            flux[b] += light.source->spectrum()[b] * light.source_sampler->flux() * area;
        }
    }
    return flux;
}

/// Sets the probability of each light: its fraction of the flux, mean over the bands that have
/// light.
void set_probabilities(
    std::vector<BoundSource>& lights, const std::vector<double>& flux, double area) {
    double sum = 0;
    for (BoundSource& light : lights) {
        light.before = sum;
        for (std::size_t b = 0; b < flux.size(); ++b) {
            const double own = light.source->spectrum()[b] * light.source_sampler->flux() * area;
            light.probability += flux[b] > 0 ? own / flux[b] : 0;
        }
        sum += light.probability;
    }
    for (BoundSource& light : lights) {
        light.probability /= sum;
        light.before /= sum;
        for (std::size_t b = 0; b < flux.size(); ++b) {
            const double own = light.source->spectrum()[b] * light.source_sampler->flux() * area;
            light.start_weights.push_back(flux[b] > 0 ? own / flux[b] / light.probability : 0);
        }
    }
}

double sum_of(std::span<const double> values) {
    double sum = 0;
    for (const double x : values) {
        sum += x;
    }
    return sum;
}

bool equal_to_rounding(const std::vector<double>& a, const std::vector<double>& b) {
    constexpr double kRounding = 1e-14;
    return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
        return std::abs(x - y) <= kRounding * std::max(x, y);
    });
}

}  // namespace

BoundLights::BoundLights(
    const Sources& sources,
    const SceneProjection& projection,
    std::size_t bands,
    std::span<const std::string> origins,
    const std::stop_token& stop) {
    const double world_area = projection.world_area();
    bind(sources, source_origins(sources, origins), projection, stop);
    flux_ = total_flux(lights_, world_area, bands);
    set_probabilities(lights_, flux_, world_area);
    double suns = 0;
    for (const BoundSource& light : lights_) {
        suns += light.source->is_sun() ? sum_of(light.source->spectrum()) : 0;
    }
    for (BoundSource& light : lights_) {
        throw_if_stopped(stop);
        if (light.source->is_sun()) {
            set_sun(light, suns, world_area);
        }
        set_spectrum(light);
    }
}

void BoundLights::bind(
    const Sources& sources,
    SourceOrigins origins,
    const SceneProjection& projection,
    const std::stop_token& stop) {
    origins_ = std::move(origins.names);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const auto& source = sources[i];
        throw_if_stopped(stop);
        std::unique_ptr<SourceSampler> source_sampler =
            model_of(*source).make_sampler_in(projection);
        if (!source_sampler || !(sum_of(source->spectrum()) > 0)) {
            continue;
        }
        BoundSource& light = lights_.emplace_back();
        light.source = source.get();
        light.origin = origins_.empty() ? 0 : origins.of_source[i];
        light.source_sampler = std::move(source_sampler);
        if (source->is_lamp()) {
            const Vec3& faces = projection.entry_box().face_area;
            light.usual_irradiance =
                light.source_sampler->flux() / std::max({faces.x, faces.y, faces.z});
        }
        if (source->is_sun()) {
            sun_area_ += light.source_sampler->flux() * projection.world_area();
        }
    }
}

void BoundLights::set_sun(BoundSource& light, double all_suns, double world_area) const {
    light.sun_share = sum_of(light.source->spectrum()) / all_suns;
    // All draws of a sun weigh the same: the integral of its radiance, for a beam 1.
    const double radiance = model_of(*light.source).illuminate({}, 0.5, 0.5).weight;
    light.lit_area = light.sun_share / light.probability * light.source_sampler->flux() *
                     world_area / sun_area_ / radiance;
}

/// Lights of one kind (sun, sky or lamp) and origin with equal start weights share a spectrum.
void BoundLights::set_spectrum(BoundSource& light) {
    const auto is_alike = [&](const BoundSource& other) {
        return other.origin == light.origin && other.source->is_sun() == light.source->is_sun() &&
               other.source->is_lamp() == light.source->is_lamp() &&
               equal_to_rounding(other.start_weights, light.start_weights);
    };
    const BoundSource* end = &light;
    const BoundSource* same =
        std::find_if(static_cast<const BoundSource*>(lights_.data()), end, is_alike);
    if (same == end) {
        light.spectrum = spectra_.size();
        spectra_.push_back(light.start_weights);
    } else {
        light.spectrum = same->spectrum;
        light.start_weights = same->start_weights;
    }
}

LightPick BoundLights::pick(double u) const {
    std::size_t low = 0;
    std::size_t high = lights_.size();
    while (high - low > 1) {
        const std::size_t middle = (low + high) / 2;
        (u < lights_[middle].before ? high : low) = middle;
    }
    const BoundSource& light = lights_[low];
    return {low, part_of_interval(u, light.before, light.probability), light.probability};
}

}  // namespace quasimc

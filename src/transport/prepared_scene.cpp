#include "transport/prepared_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/distribution.h"
#include "base/stop.h"
#include "detectors/catalogue.h"

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

/// Every band gives each light its share of the band's flux; the mean over the bands that have
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

/// By which part of itself an amount of light is mended, at least.
constexpr double kLeastMended = 1e-4;

/// What light comes to the steeper is not mended.
double grazing_cosine(const LocalMesh& mesh) {
    constexpr double kGrazing = 0.1;
    return mesh.instances.empty() ? std::min(kGrazing, mesh.most_turned / kLeastMended) : kGrazing;
}

}  // namespace

PreparedScene::PreparedScene(
    const Scene& scene,
    const Sources& sources,
    CrossSectionShape window,
    std::shared_ptr<const RayCaster> caster,
    const std::stop_token& stop)
    : scene_(&scene),
      caster_(std::move(caster)),
      projection_(*caster_, window),
      grazing_(grazing_cosine(caster_->mesh())) {
    set_regions();
    set_fields_of_view();
    set_lights(sources, stop);
    for (const DetectorSpec& detector : scene.detectors()) {
        detectors_.push_back(make_detector(detector));
    }
}

void PreparedScene::set_regions() {
    const Scene& scene = *scene_;
    triangle_regions_ = *data_of(scene).triangle_regions;
    if (!caster_->has_own_numbers()) {
        const auto count = static_cast<std::uint32_t>(caster_->mesh().faces.size());
        image_regions_.reserve(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            image_regions_.push_back(data_of(scene).region_of(caster_->source(i)));
        }
        triangle_regions_ = image_regions_;
    }
    materials_ = data_of(scene).materials.data();
    const std::vector<bool> is_used = used_materials(scene);
    region_materials_.reserve(scene.regions().size());
    for (const Region& region : scene.regions()) {
        region_materials_.push_back(region.material);
        ground_regions_ += scene.organs()[region.organ.value].is_ground ? 1 : 0;
    }
    for (std::size_t i = 0; i < is_used.size(); ++i) {
        const Material& material = data_of(scene).materials[i];
        has_transparent_ = has_transparent_ || (is_used[i] && material.is_transparent());
        // Light passes a sensor as if it were not there.
        const bool scatters = is_used[i] && !material.is_transparent();
        for (const SurfaceSide side : kSurfaceSides) {
            const double peak = scatters ? material.side(side).sharpest_peak() : 0;
            sharpest_peak_ = std::max(sharpest_peak_, peak);
        }
        has_constant_albedos_ =
            has_constant_albedos_ && (!is_used[i] || material.has_constant_albedo());
    }
}

void PreparedScene::set_fields_of_view() {
    for (const Organ& organ : scene_->organs()) {
        has_narrow_ = has_narrow_ || organ.least_cosine > 0;
    }
    for (std::size_t e = 0; has_narrow_ && e < scene_->regions().size(); ++e) {
        const OrganIndex organ = scene_->regions()[e].organ;
        least_cosine_.push_back(scene_->organs()[organ.value].least_cosine);
    }
}

void PreparedScene::set_lights(const Sources& sources, const std::stop_token& stop) {
    double sun = 0;
    for (const auto& source : sources) {
        throw_if_stopped(stop);
        std::unique_ptr<SourceSampler> source_sampler =
            model_of(*source).make_sampler_in(projection_);
        if (source_sampler && sum_of(source->spectrum()) > 0) {
            BoundSource& light = lights_.emplace_back();
            light.source = source.get();
            light.source_sampler = std::move(source_sampler);
            if (source->is_lamp()) {
                const Vec3& faces = projection_.entry_box().face_area;
                light.usual_irradiance =
                    light.source_sampler->flux() / std::max({faces.x, faces.y, faces.z});
            }
            if (source->is_sun()) {
                sun += sum_of(source->spectrum());
                sun_area_ += lights_.back().source_sampler->flux() * world_area();
            }
        }
    }
    flux_ = total_flux(lights_, world_area(), bands());
    set_probabilities(lights_, flux_, world_area());
    for (BoundSource& light : lights_) {
        throw_if_stopped(stop);
        if (light.source->is_sun()) {
            light.sun_share = sum_of(light.source->spectrum()) / sun;
            // All draws of a sun weigh the same: the integral of its radiance, for a beam 1.
            const double radiance = model_of(*light.source).illuminate({}, 0.5, 0.5).weight;
            light.lit_area = light.sun_share / light.probability * light.source_sampler->flux() *
                             world_area() / sun_area_ / radiance;
        }
        set_spectrum(light);
    }
}

/// Lights of one kind with equal start weights have a spectrum in common.
void PreparedScene::set_spectrum(BoundSource& light) {
    const auto is_alike = [&](const BoundSource& other) {
        return other.source->is_sun() == light.source->is_sun() &&
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

double PreparedScene::grazed_share(std::uint32_t mesh_triangle, const Vec3& direction) const {
    const double scale = caster_->mesh().scale;
    const Vec3 given = area_vector(data_of(*scene_).triangles()[caster_->source(mesh_triangle)]);
    const double exact = scale * scale * std::abs(dot(given, direction));
    const double rounded = std::abs(dot(caster_->mesh().across(mesh_triangle), direction));
    return rounded > 0 && std::abs(exact - rounded) > kLeastMended * rounded ? exact / rounded : 1;
}

bool PreparedScene::lights_as_given(std::uint32_t mesh_triangle, const Vec3& direction) const {
    const Vec3 across = area_vector(data_of(*scene_).triangles()[caster_->source(mesh_triangle)]);
    return std::abs(dot(across, direction)) > kEdgeOn * length(across);
}

LightPick PreparedScene::pick_light(double u) const {
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

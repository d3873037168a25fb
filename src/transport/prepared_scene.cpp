#include "transport/prepared_scene.h"

#include <algorithm>
#include <utility>

#include "detectors/catalogue.h"

namespace quasimc {
namespace {

OpticsTraits optics_of(const Scene& scene) {
    OpticsTraits optics;
    const std::vector<bool> is_used = used_materials(scene);
    for (std::size_t i = 0; i < is_used.size(); ++i) {
        if (!is_used[i]) {
            continue;
        }
        const Material& material = data_of(scene).materials[i];
        optics.has_transparent = optics.has_transparent || material.is_transparent();
        optics.has_constant_albedos = optics.has_constant_albedos && material.has_constant_albedo();
        for (const SurfaceSide side : kSurfaceSides) {
            // Light passes a sensor as if it were not there.
            const double peak = material.is_transparent() ? 0 : material.side(side).largest_peak();
            optics.largest_peak = std::max(optics.largest_peak, peak);
        }
    }
    return optics;
}

}  // namespace

PreparedScene::PreparedScene(
    const Scene& scene,
    const Sources& sources,
    StartArea start_area,
    std::shared_ptr<const RayCaster> caster,
    const std::stop_token& stop,
    std::span<const std::string> origins)
    : scene_(&scene),
      caster_(std::move(caster)),
      projection_(*caster_, start_area),
      lights_(sources, projection_, scene.bands().size(), origins, stop),
      fields_of_view_(scene),
      rounding_(scene, *caster_),
      optics_(optics_of(scene)) {
    set_regions();
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
    region_materials_.reserve(scene.regions().size());
    for (const Region& region : scene.regions()) {
        region_materials_.push_back(region.material);
    }
}

}  // namespace quasimc

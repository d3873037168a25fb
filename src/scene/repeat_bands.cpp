#include "scene/repeat_bands.h"

#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace quasimc {
namespace {

Side repeated(const Side& side, std::size_t bands, std::size_t times) {
    std::vector<Lobe> lobes = side.lobes();
    for (Lobe& lobe : lobes) {
        const std::vector<double> once = std::move(lobe.albedo);
        lobe.albedo.clear();
        for (const double albedo : once) {
            lobe.albedo.insert(lobe.albedo.end(), times, albedo);
        }
    }
    return Side(lobes, bands * times);
}

}  // namespace

Scene with_repeated_bands(const Scene& scene, std::size_t times) {
    return SceneAccess::with_repeated_bands(scene, times);
}

Scene SceneAccess::with_repeated_bands(const Scene& scene, std::size_t times) {
    const std::size_t bands = scene.bands().size();
    std::vector<Band> repeated_bands;
    for (const Band& band : scene.bands()) {
        for (std::size_t i = 0; i < times; ++i) {
            repeated_bands.push_back(band);
            repeated_bands.back().name = fmt::format("{} {}", band.name, i);
        }
    }
    SceneData data = data_of(scene);
    data.materials.clear();
    for (const Material& material : data_of(scene).materials) {
        data.materials.emplace_back(
            material.name(), repeated(material.side(SurfaceSide::upper), bands, times),
            repeated(material.side(SurfaceSide::lower), bands, times));
    }
    Scene repeat = scene;
    repeat.names_ = std::make_shared<const SceneNames>(std::move(repeated_bands), scene.organs());
    repeat.data_ = std::make_shared<const SceneData>(std::move(data));
    repeat.detectors_.clear();
    repeat.sensors_ = std::make_shared<const std::vector<SensorSet>>();
    return repeat;
}

}  // namespace quasimc

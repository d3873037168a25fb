#include "scene/repeat_bands.h"

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
    Scene repeat = scene;
    const std::size_t bands = scene.bands().size();
    repeat.bands_.clear();
    for (const Band& band : scene.bands()) {
        for (std::size_t i = 0; i < times; ++i) {
            repeat.bands_.push_back(band);
            repeat.bands_.back().name = fmt::format("{} {}", band.name, i);
        }
    }
    repeat.materials_.clear();
    for (const Material& material : scene.materials()) {
        repeat.materials_.emplace_back(
            material.name(), repeated(material.side(SurfaceSide::upper), bands, times),
            repeated(material.side(SurfaceSide::lower), bands, times));
    }
    repeat.detectors_.clear();
    return repeat;
}

}  // namespace quasimc

#include "scene/scene.h"

#include <algorithm>

#include "base/lazy.h"
#include "scene/organ_areas.h"

namespace quasimc {

const Labels& SharedLabels::none() {
    static const Labels kNone;
    return kNone;
}

Scene::Scene() = default;
Scene::Scene(const Scene& other) = default;
Scene::Scene(Scene&& other) noexcept = default;
Scene& Scene::operator=(const Scene& other) = default;
Scene& Scene::operator=(Scene&& other) noexcept = default;
Scene::~Scene() = default;

std::span<const RegionIndex> Scene::triangle_regions() const {
    return *triangle_regions_;
}

std::size_t Scene::triangle_count() const {
    return geometry_->size();
}

std::vector<std::string> Scene::material_names() const {
    std::vector<std::string> names;
    names.reserve(materials_.size());
    for (const Material& material : materials_) {
        names.push_back(material.name());
    }
    return names;
}

const Material& Scene::material(const Region& region) const {
    return materials_[region.material.value];
}

const std::string& Scene::material_name(const Region& region) const {
    return material(region).name();
}

std::vector<Triangle> Scene::triangles_of(const Organ& organ) const {
    std::vector<Triangle> triangles;
    triangles.reserve(organ.triangle_count);
    for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
        triangles.push_back((*geometry_)[organ.first_triangle + i]);
    }
    return triangles;
}

RegionIndex Scene::region_of(std::uint32_t triangle) const {
    const std::span<const RegionIndex> own = triangle_regions();
    return triangle < own.size() ? own[triangle]
                                 : instance_regions_[geometry_->ranges().find(triangle)];
}

std::vector<bool> used_materials(const Scene& scene) {
    std::vector<bool> is_used(scene.materials().size());
    for (const Region& region : scene.regions()) {
        is_used[region.material.value] = true;
    }
    return is_used;
}

std::vector<double> largest_albedos(const Scene& scene) {
    std::vector<double> largest(scene.bands().size());
    const std::vector<bool> is_used = used_materials(scene);
    for (std::size_t m = 0; m < is_used.size(); ++m) {
        const Material& material = scene.materials()[m];
        if (!is_used[m] || material.is_transparent()) {
            continue;
        }
        for (const SurfaceSide side : kSurfaceSides) {
            for (std::size_t b = 0; b < largest.size(); ++b) {
                largest[b] = std::max(largest[b], material.side(side).albedo()[b]);
            }
        }
    }
    return largest;
}

}  // namespace quasimc

#include "scene/scene.h"

#include <algorithm>

#include "base/lazy.h"
#include "scene/organ_areas.h"

namespace quasimc {

const std::string* find_label(const Labels& labels, std::string_view key) {
    const auto found =
        std::find_if(labels.begin(), labels.end(), [&](const auto& l) { return l.first == key; });
    return found == labels.end() ? nullptr : &found->second;
}

const Labels& SharedLabels::none() {
    static const Labels kNone;
    return kNone;
}

std::size_t Scene::triangle_count() const {
    return data_->geometry->size();
}

std::vector<std::string> Scene::material_names() const {
    std::vector<std::string> names;
    names.reserve(data_->materials.size());
    for (const Material& material : data_->materials) {
        names.push_back(material.name());
    }
    return names;
}

const std::string& Scene::material_name(const Region& region) const {
    return data_->material(region).name();
}

std::vector<Triangle> Scene::triangles_of(const Organ& organ) const {
    std::vector<Triangle> triangles;
    triangles.reserve(organ.triangle_count);
    for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
        triangles.push_back(data_->triangles()[organ.first_triangle + i]);
    }
    return triangles;
}

RegionIndex SceneData::region_of(std::uint32_t triangle) const {
    return triangle < triangle_regions->size()
               ? (*triangle_regions)[triangle]
               : instance_regions[geometry->ranges().find(triangle)];
}

bool is_in_reach(const Scene& scene, const Vec3& center, double radius) {
    constexpr double kMaxRadii = 1e6;
    return length(center - scene.bounds().center()) + radius <= kMaxRadii * scene.bounds().radius();
}

std::vector<bool> used_materials(const Scene& scene) {
    std::vector<bool> is_used(data_of(scene).materials.size());
    for (const Region& region : scene.regions()) {
        is_used[region.material.value] = true;
    }
    return is_used;
}

std::vector<double> largest_albedos(const Scene& scene) {
    std::vector<double> largest(scene.bands().size());
    const std::vector<bool> is_used = used_materials(scene);
    for (std::size_t m = 0; m < is_used.size(); ++m) {
        const Material& material = data_of(scene).materials[m];
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

#include "results/organ_values.h"

#include <algorithm>
#include <array>

#include "results/groups.h"
#include "results/organ_height.h"

namespace quasimc {
namespace {

std::optional<WhereValue> id_of(const Scene&, const Organ& organ) {
    return WhereValue{std::to_string(organ.id), static_cast<double>(organ.id)};
}

std::optional<WhereValue> name_of(const Scene&, const Organ& organ) {
    return WhereValue{organ.name};
}

std::optional<WhereValue> material_of(const Scene& scene, const Organ& organ) {
    const auto first = scene.regions().begin() + organ.first_region;
    const auto largest = std::max_element(
        first, first + organ.region_count,
        [](const Region& a, const Region& b) { return a.area < b.area; });
    return WhereValue{scene.material_name(*largest)};
}

std::optional<WhereValue> area_of(const Scene&, const Organ& organ) {
    return WhereValue::of_number(organ.area);
}

std::optional<WhereValue> centroid_height_of(const Scene& scene, const Organ& organ) {
    return WhereValue::of_number(height_of(scene, organ).centroid);
}

/// A property of organs that is no label.
struct OrganProperty {
    std::string_view name;
    std::optional<WhereValue> (*value)(const Scene& scene, const Organ& organ);
};
constexpr std::array kProperties{
    OrganProperty{"id", id_of}, OrganProperty{"name", name_of},
    OrganProperty{"material", material_of}, OrganProperty{"area", area_of},
    OrganProperty{"height", centroid_height_of}};

}  // namespace

OrganValues::OrganValues(const Scene& scene, const GroupSpec& spec)
    : scene_(scene), boundaries_(layer_boundaries(scene, spec)) {}

std::optional<WhereValue> OrganValues::value(const Organ& organ, std::string_view name) const {
    if (const std::string* label = find_label(organ.labels, name)) {
        return WhereValue::of_text(*label);
    }
    if (name == kLayer && is_plant(scene_, organ)) {
        const auto layer = layer_at(boundaries_, height_of(scene_, organ).centroid);
        return layer ? std::optional(WhereValue::of_text(std::to_string(*layer + 1)))
                     : std::nullopt;
    }
    const auto* property = std::find_if(
        kProperties.begin(), kProperties.end(), [&](const auto& p) { return p.name == name; });
    return property == kProperties.end() ? std::nullopt : property->value(scene_, organ);
}

bool OrganValues::holds(const WhereExpression& where, const Organ& organ) const {
    return where.holds([&](std::string_view name) { return value(organ, name); });
}

std::vector<std::string_view> OrganValues::names() const {
    std::vector<std::string_view> names = label_keys(scene_);
    for (const OrganProperty& property : kProperties) {
        names.push_back(property.name);
    }
    if (boundaries_.size() >= 2) {
        names.push_back(kLayer);
    }
    return names;
}

}  // namespace quasimc

#include "results/groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "base/vec3.h"
#include "results/group_request.h"
#include "results/organ_height.h"
#include "results/organ_values.h"

namespace quasimc {
namespace {

constexpr std::string_view kMaterial = "material";

bool is_among(std::string_view name, const std::vector<std::string_view>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The value of a key by which groups are formed: a label, the layer or the material.
std::optional<std::string> key_value(
    const OrganValues& values, const Organ& organ, std::string_view key) {
    const bool is_key =
        find_label(organ.labels, key) != nullptr || key == kLayer || key == kMaterial;
    std::optional<WhereValue> value = is_key ? values.value(organ, key) : std::nullopt;
    return value ? std::optional(std::move(value->text)) : std::nullopt;
}

/// The values of an organ's keys; empty if it lacks one of them.
std::optional<Labels> values_of_keys(
    const OrganValues& values, const Organ& organ, const std::vector<std::string>& keys) {
    Labels labels;
    for (const std::string& key : keys) {
        std::optional<std::string> value = key_value(values, organ, key);
        if (!value) {
            return std::nullopt;
        }
        labels.emplace_back(key, std::move(*value));
    }
    return labels;
}

std::string joined_values(const Labels& labels) {
    std::string text;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        text += (i == 0 ? "" : "+") + labels[i].second;
    }
    return text;
}

void add_to_group(OrganGroup& group, const Scene& scene, std::uint32_t organ) {
    group.organs.push_back(organ);
    group.area += scene.organs()[organ].area;
}

OrganGroup group_of_all(const Scene& scene) {
    OrganGroup all{.by = std::string(kAllOrgans), .value = ""};
    all.organs.reserve(scene.organs().size());
    for (std::uint32_t i = 0; i < scene.organs().size(); ++i) {
        if (is_plant(scene, scene.organs()[i])) {
            add_to_group(all, scene, i);
        }
    }
    return all;
}

void add_requested(
    const Scene& scene,
    const OrganValues& values,
    const GroupRequest& request,
    std::vector<OrganGroup>& groups) {
    std::unordered_map<std::string, std::size_t> known;
    for (std::uint32_t i = 0; i < scene.organs().size(); ++i) {
        const Organ& organ = scene.organs()[i];
        if (!is_counted(organ) || (request.where && !values.holds(*request.where, organ))) {
            continue;
        }
        std::optional<Labels> labels = values_of_keys(values, organ, request.keys);
        if (!labels) {
            continue;
        }
        const std::string value = joined_values(*labels);
        const auto [found, is_new] = known.try_emplace(value, groups.size());
        if (is_new) {
            groups.push_back({.by = request.by, .value = value, .labels = std::move(*labels)});
        }
        add_to_group(groups[found->second], scene, i);
    }
}

void add_layers(
    const Scene& scene, const std::vector<double>& heights, std::vector<OrganGroup>& groups) {
    if (heights.size() < 2) {
        return;
    }
    std::vector<OrganGroup> layers(heights.size() - 1);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        layers[i].by = kLayer;
        layers[i].value = std::to_string(i + 1);
        layers[i].labels = {{std::string(kLayer), layers[i].value}};
        layers[i].height_min = heights[i];
        layers[i].height_max = heights[i + 1];
    }
    for (std::uint32_t i = 0; i < scene.organs().size(); ++i) {
        const Organ& organ = scene.organs()[i];
        if (!is_plant(scene, organ)) {
            continue;
        }
        if (const auto layer = layer_at(heights, height_of(scene, organ).centroid)) {
            add_to_group(layers[*layer], scene, i);
        }
    }
    const double ground = horizontal_area(scene);
    double sum = 0;
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
        sum += layer->area;
        layer->plant_area_index = layer->area / ground;
        layer->cumulative_plant_area_index = sum / ground;
    }
    groups.insert(
        groups.end(), std::make_move_iterator(layers.begin()),
        std::make_move_iterator(layers.end()));
}

void check_keys_of_group(
    const GroupRequest& request,
    const std::vector<std::string_view>& known,
    bool has_layer_label,
    Faults& faults) {
    if (request.keys == std::vector{std::string(kLayer)} && !request.where && !has_layer_label) {
        faults.add(
            {"groups", "'layer' is a group already", "layers and layer_heights form groups",
             "remove it"});
        return;
    }
    for (const std::string& key : request.keys) {
        if (is_among(key, known) || key == kMaterial) {
            continue;
        }
        if (key == kLayer) {
            faults.add(
                {"groups", "there are no layers", "layer is the number of a layer",
                 "give layers or layer_heights"});
            continue;
        }
        faults.add(
            {"groups", fmt::format("no organ has a label '{}'", key),
             known.empty() ? "no organ has any label"
                           : "groups are formed by the values of a label",
             known.empty() ? "give organs labels" : did_you_mean(key, known)});
    }
}

/// Checks that a name is not that of other groups.
void check_name_of_group(
    const GroupRequest& request,
    const std::string& text,
    std::map<std::string, std::string>& texts,
    Faults& faults) {
    const auto [known, is_new] = texts.try_emplace(request.by, text);
    const bool is_reserved =
        request.by != text && (request.by == kAllOrgans || request.by == kLayer);
    if (is_reserved || (!is_new && known->second != text)) {
        faults.add(
            {"groups", fmt::format("other groups have the name '{}'", request.by),
             "their rows could not be distinguished", "use another name"});
    }
}

void check_requests(const Scene& scene, const GroupSpec& spec, Faults& faults) {
    std::vector<std::string_view> known = label_keys(scene);
    const OrganValues values(scene, spec);
    const bool has_layer_label = is_among(kLayer, known);
    const bool has_layers = spec.layers > 0 || !spec.layer_heights.empty();
    if (is_among(kLayer, values.names())) {
        known.push_back(kLayer);
    }
    std::map<std::string, std::string> texts;  // by name
    for (const std::string& text : spec.labels) {
        try {
            const GroupRequest request = parse_group(text, known);
            check_name_of_group(request, text, texts, faults);
            check_keys_of_group(request, known, has_layer_label, faults);
            if (has_layers && has_layer_label && std::ranges::count(request.keys, kLayer) > 0) {
                faults.add(
                    {"groups", "'layer' is a label and the number of a layer",
                     "groups would be of one or the other", "rename the label"});
            }
            if (request.where) {
                request.where->check_names(values.names(), "label");
            }
        } catch (const InputError& error) {
            for (Fault fault : error.faults()) {
                fault.problem = fmt::format("where: {}", fault.problem);
                fault.where = "groups";
                faults.add(std::move(fault));
            }
        }
    }
}

/// Refuses layers of a scene without height.
void check_layers(const Scene& scene, const GroupSpec& spec, Faults& faults) {
    if (spec.layers > 0 && spec.layer_heights.empty()) {
        const std::vector<double> equal = layer_boundaries(scene, spec);
        if (!(equal.front() < equal.back())) {
            faults.add(
                {"layers",
                 fmt::format("{} layers, but organs have no vertical extent", spec.layers),
                 "they are in one horizontal plane, or there are none",
                 "set layer_heights = [...]"});
        }
    }
}

}  // namespace

void check_layer_heights(const GroupSpec& spec, Faults& faults) {
    const std::vector<double>& heights = spec.layer_heights;
    if (spec.layers > 0 && !heights.empty()) {
        faults.add(
            {"layers", "both layers and layer_heights are given",
             "one is a number of equal layers, the other their boundaries", "remove one of them"});
        return;
    }
    if (heights.size() == 1) {
        faults.add(
            {"layer_heights", fmt::format("[{}]", shortest(heights.front())),
             "a layer needs a lower and an upper boundary", "give at least two heights"});
    }
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const bool ascends = i == 0 || heights[i - 1] < heights[i];
        if (!std::isfinite(heights[i]) || !ascends) {
            faults.add(
                {"layer_heights",
                 i == 0
                     ? fmt::format("{} is not a height", shortest(heights[i]))
                     : fmt::format("{} follows {}", shortest(heights[i]), shortest(heights[i - 1])),
                 "heights must be finite and ascending", "give them in ascending order"});
            return;
        }
    }
}

bool is_sensor(const Scene& scene, const Organ& organ) {
    for (std::uint32_t i = 0; i < organ.region_count; ++i) {
        if (!data_of(scene).material(scene.regions()[organ.first_region + i]).is_transparent()) {
            return false;
        }
    }
    return true;
}

std::vector<std::string_view> label_keys(const Scene& scene) {
    std::vector<std::string_view> keys;
    std::unordered_set<std::string_view> seen;
    for (const Organ& organ : scene.organs()) {
        for (const auto& [key, value] : organ.labels) {
            if (seen.insert(key).second) {
                keys.push_back(key);
            }
        }
    }
    return keys;
}

void check_groups(const Scene& scene, const GroupSpec& spec, Faults& faults) {
    check_requests(scene, spec, faults);
    check_layer_heights(spec, faults);
    check_layers(scene, spec, faults);
}

std::vector<OrganGroup> make_groups(const Scene& scene, const GroupSpec& spec) {
    std::vector<OrganGroup> groups;
    groups.push_back(group_of_all(scene));
    const std::vector<std::string_view> known = label_keys(scene);
    const OrganValues values(scene, spec);
    for (const std::string& text : spec.labels) {
        add_requested(scene, values, parse_group(text, known), groups);
    }
    add_layers(scene, values.boundaries(), groups);
    return groups;
}

double horizontal_area(const Scene& scene) {
    const Cell& cell = scene.cell();
    if (cell.along_x && cell.along_y) {
        return cell.size_x * cell.size_y;
    }
    const auto ground = std::find_if(
        scene.organs().begin(), scene.organs().end(),
        [](const Organ& organ) { return organ.is_ground; });
    if (ground == scene.organs().end()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    double sum = 0;
    for (const auto& [a, b, c] : scene.triangles_of(*ground)) {
        sum += std::abs(cross(b - a, c - a).z) / 2;
    }
    return sum;
}

}  // namespace quasimc

#include "results/groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "base/vec3.h"

namespace quasimc {
namespace {

/// Whether an organ's light is summed with that of others.
bool is_counted(const Organ& organ) {
    return organ.measured && !organ.is_ground;
}

/// Whether an organ is part of the canopy, and so of layers.
bool is_plant(const Scene& scene, const Organ& organ) {
    return is_counted(organ) && !is_sensor(scene, organ);
}

const std::string* label_of(const Organ& organ, std::string_view key) {
    const auto found = std::find_if(
        organ.labels.begin(), organ.labels.end(), [&](const auto& l) { return l.first == key; });
    return found == organ.labels.end() ? nullptr : &found->second;
}

/// The keys that "plant+kind" joins. A key that itself contains '+' is a single key.
std::vector<std::string_view> joined_keys(
    std::string_view text, const std::vector<std::string_view>& known) {
    std::vector<std::string_view> keys;
    if (std::find(known.begin(), known.end(), text) != known.end()) {
        return {text};
    }
    while (true) {
        const std::size_t end = std::min(text.find('+'), text.size());
        keys.push_back(text.substr(0, end));
        if (end == text.size()) {
            return keys;
        }
        text.remove_prefix(end + 1);
    }
}

/// The values of an organ's labels, joined; nothing if it lacks one of them.
std::optional<std::string> joined_values(
    const Organ& organ, const std::vector<std::string_view>& keys) {
    std::string text;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const std::string* value = label_of(organ, keys[i]);
        if (value == nullptr) {
            return std::nullopt;
        }
        text += (i == 0 ? "" : "+") + *value;
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

void add_groups_of_labels(
    const Scene& scene,
    const std::string& by,
    const std::vector<std::string_view>& keys,
    std::vector<OrganGroup>& groups) {
    std::unordered_map<std::string, std::size_t> known;
    for (std::uint32_t i = 0; i < scene.organs().size(); ++i) {
        const Organ& organ = scene.organs()[i];
        const auto value = is_counted(organ) ? joined_values(organ, keys) : std::nullopt;
        if (!value) {
            continue;
        }
        const auto [found, is_new] = known.try_emplace(*value, groups.size());
        if (is_new) {
            groups.push_back({.by = by, .value = *value});
        }
        add_to_group(groups[found->second], scene, i);
    }
}

/// Height of an organ.
struct OrganHeight {
    double centroid = 0;  ///< of its area
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};

OrganHeight height_of(const Scene& scene, const Organ& organ) {
    OrganHeight height;
    double area_sum = 0;
    double time_step = 0;
    double plain = 0;  // for an organ of no area
    for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
        const Triangle triangle = data_of(scene).triangles()[std::size_t{organ.first_triangle} + i];
        const auto& [a, b, c] = triangle;
        const double middle = (a.z + b.z + c.z) / 3;
        const double own = area(triangle);
        area_sum += own;
        time_step += own * middle;
        plain += middle / organ.triangle_count;
        height.low = std::min({height.low, a.z, b.z, c.z});
        height.high = std::max({height.high, a.z, b.z, c.z});
    }
    height.centroid = area_sum > 0 ? time_step / area_sum : plain;
    return height;
}

/// The boundaries of layers of equal height; they do not ascend where the organs have no height.
std::vector<double> equal_layers(const Scene& scene, std::uint32_t layers) {
    OrganHeight all;
    for (const Organ& organ : scene.organs()) {
        if (!organ.is_ground && !is_plant(scene, organ)) {
            continue;
        }
        const OrganHeight own = height_of(scene, organ);
        all.low = std::min(all.low, organ.is_ground ? own.centroid : own.low);
        all.high = std::max(all.high, organ.is_ground ? all.high : own.high);
    }
    std::vector<double> heights;
    for (std::uint32_t i = 0; i <= layers; ++i) {
        const double part = static_cast<double>(i) / layers;
        heights.push_back(i == layers ? all.high : all.low + part * (all.high - all.low));
    }
    return heights;
}

std::vector<double> heights_of_layers(const Scene& scene, const GroupSpec& spec) {
    return spec.layers > 0 ? equal_layers(scene, spec.layers) : spec.layer_heights;
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
        layers[i].height_min = heights[i];
        layers[i].height_max = heights[i + 1];
    }
    for (std::uint32_t i = 0; i < scene.organs().size(); ++i) {
        const Organ& organ = scene.organs()[i];
        if (!is_plant(scene, organ)) {
            continue;
        }
        const double z = height_of(scene, organ).centroid;
        if (heights.front() <= z && z <= heights.back()) {
            const auto above = std::upper_bound(heights.begin() + 1, heights.end() - 1, z);
            add_to_group(layers[static_cast<std::size_t>(above - heights.begin()) - 1], scene, i);
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

void check_labels(const Scene& scene, const GroupSpec& spec, Faults& faults) {
    const std::vector<std::string_view> known = label_keys(scene);
    for (const std::string& text : spec.labels) {
        for (const std::string_view key : joined_keys(text, known)) {
            if (std::find(known.begin(), known.end(), key) == known.end()) {
                faults.add(
                    {"groups", fmt::format("no organ has a label '{}'", key),
                     known.empty() ? "no organ has any label"
                                   : "groups are formed by the values of a label",
                     known.empty() ? "give organs labels = { plant = 1 }"
                                   : did_you_mean(key, known)});
            }
        }
    }
}

void check_layers(const Scene& scene, const GroupSpec& spec, Faults& faults) {
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
    if (spec.layers > 0) {
        const std::vector<double> equal = equal_layers(scene, spec.layers);
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
    check_labels(scene, spec, faults);
    check_layers(scene, spec, faults);
}

std::vector<OrganGroup> make_groups(const Scene& scene, const GroupSpec& spec) {
    std::vector<OrganGroup> groups;
    groups.push_back(group_of_all(scene));
    const std::vector<std::string_view> known = label_keys(scene);
    for (const std::string& text : spec.labels) {
        add_groups_of_labels(scene, text, joined_keys(text, known), groups);
    }
    add_layers(scene, heights_of_layers(scene, spec), groups);
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

#include "window/window_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/vec3.h"
#include "quasimc/version.h"
#include "resultio/describe_series.h"
#include "resultio/json_parts.h"
#include "results/units.h"
#include "scene/sensors.h"
#include "window/window_shape.h"

namespace quasimc {
namespace {

constexpr int kRings = 9, kSectors = 36;

bool is_sky(const Source& source) {
    return source.traits().at_infinity && source.traits().extended;
}

/// Radiances of all skies together, of all bands, by cells.
std::vector<double> sky_cells(const Sources& sources) {
    std::vector<double> cells(std::size_t{kRings} * kSectors);
    for (const auto& source : sources) {
        if (!is_sky(*source)) {
            continue;
        }
        const auto spectrum = source->spectrum();
        const double all = std::accumulate(spectrum.begin(), spectrum.end(), 0.0);
        for (int i = 0; i < kRings * kSectors; ++i) {
            const int ring = i / kSectors, sector = i % kSectors;
            const double elevation = (ring + 0.5) * std::numbers::pi / 2 / kRings;
            const double azimuth = (sector + 0.5) * 2 * std::numbers::pi / kSectors;
            cells[static_cast<std::size_t>(i)] +=
                all * model_of(*source).radiance(
                          {std::cos(elevation) * std::cos(azimuth),
                           std::cos(elevation) * std::sin(azimuth), std::sin(elevation)});
        }
    }
    return cells;
}

std::string sky_digits(const std::vector<double>& cells) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const double most = *std::max_element(cells.begin(), cells.end());
    if (!(most > 0)) {
        return {};
    }
    std::string digits;
    for (const double cell : cells) {
        const double part = std::sqrt(std::clamp(cell / most, 0.0, 1.0));
        digits += kDigits[static_cast<std::size_t>(std::lround(part * 63))];
    }
    return digits;
}

/// A key of labels: its values, and which of them each organ has, -1 for none.
struct LabelKey {
    std::vector<std::string> values;
    std::map<std::string, int> numbers;
    std::vector<int> of;
};

std::map<std::string, LabelKey> label_keys(const std::vector<const Organ*>& organs) {
    std::map<std::string, LabelKey> keys;
    for (std::size_t i = 0; i < organs.size(); ++i) {
        for (const auto& [name, value] : organs[i]->labels) {
            LabelKey& key = keys[name];
            key.of.resize(organs.size(), -1);
            const auto [found, is_new] =
                key.numbers.try_emplace(value, static_cast<int>(key.values.size()));
            if (is_new) {
                key.values.push_back(value);
            }
            key.of[i] = found->second;
        }
    }
    return keys;
}

Json labels_of(const std::vector<const Organ*>& organs) {
    Json labels = Json::object();
    for (const auto& [name, key] : label_keys(organs)) {
        labels[name] = {{"values", key.values}, {"of", key.of}};
    }
    return labels;
}

/// Ids and names are written only if they differ from the index in the list; the page calls organ 7
/// without a name "organ 7".
Json organs_of(const WindowOrgans& list) {
    const std::vector<const Organ*>& organs = list.all();
    bool has_ids = list.sensors() > 0, has_names = false;
    for (std::size_t i = 0; i < organs.size(); ++i) {
        const Organ& organ = *organs[i];
        has_ids |= organ.id != static_cast<std::int64_t>(i) + 1;
        has_names |= !organ.name.empty() && organ.name != "organ " + std::to_string(organ.id);
    }
    Json ids = Json::array(), names = Json::array(), ground = Json::array();
    for (std::size_t i = 0; i < organs.size(); ++i) {
        if (has_ids) {
            ids.push_back(list.id_of(i));  // may exceed the exact integers of a JSON number
        }
        if (has_names) {
            names.push_back(organs[i]->name);
        }
        if (organs[i]->is_ground) {
            ground.push_back(i);
        }
    }
    Json all = {{"count", organs.size()}, {"ground", ground}, {"labels", labels_of(organs)}};
    if (has_ids) {
        all["id"] = std::move(ids);
    }
    if (has_names) {
        all["name"] = std::move(names);
    }
    return all;
}

Json json_sensors(const Scene& scene, const Vec3& middle) {
    Json positions = Json::array();
    for (const Vec3& position : sensor_positions(scene)) {
        positions.push_back(json_vector(position - middle));
    }
    return positions;
}

/// The vectors by which a scene repeats, z up: none, one or two.
Json json_periods(const Cell& cell) {
    Json periods = Json::array();
    if (cell.along_x) {
        periods.push_back(json_vector({cell.size_x, 0, 0}));
    }
    if (cell.along_y) {
        periods.push_back(json_vector({0, cell.size_y, 0}));
    }
    return periods;
}

}  // namespace

Json json_lights(const Sources& sources, const Vec3& middle) {
    Json suns = Json::array(), lamps = Json::array();
    for (const auto& source : sources) {
        if (source->is_sun()) {
            suns.push_back(json_vector(model_of(*source).illuminate({}, 0.5, 0.5).to_light));
        } else if (source->is_lamp()) {
            const Illumination light = model_of(*source).illuminate({}, 0.5, 0.5);
            lamps.push_back(json_vector(light.distance * light.to_light - middle));
        }
    }
    return {{"suns", suns}, {"lamps", lamps}, {"sky", sky_digits(sky_cells(sources))}};
}

std::vector<WindowColumn> window_columns(
    const std::vector<Band>& bands,
    const std::string& length_unit,
    const std::vector<std::string>& ratios) {
    std::vector<WindowColumn> columns;
    for (const QuantityEntry& entry : quantity_table()) {
        const std::string name(entry.name);
        for (const Band& band : bands) {
            const std::string unit = unit_of(entry, band, length_unit);
            columns.push_back(
                {{name, band.name},
                 name,
                 describe_quantity(name),
                 band.name,
                 unit,
                 summed_unit(unit).name});
        }
    }
    // The most used column comes first: light absorbed per area.
    std::stable_partition(columns.begin(), columns.end(), [](const WindowColumn& column) {
        return column.quantity == "absorbed_flux_density";
    });
    columns.push_back({{"sunlit_fraction"}, "sunlit_fraction", "sunlit fraction", "", "", ""});
    for (const std::string& ratio : ratios) {
        columns.push_back({{"ratios", ratio}, ratio, ratio, "", "", ""});
    }
    return columns;
}

Json json_window_scene(
    const Scene& scene, const WindowOrgans& organs, const std::vector<WindowColumn>& columns) {
    const Orientation& axes = scene.orientation();
    const Vec3 middle = window_middle(scene);
    Json list = Json::array();
    for (const WindowColumn& column : columns) {
        list.push_back(
            {{"quantity", column.quantity},
             {"name", column.name},
             {"band", column.band},
             {"unit", column.unit},
             {"sum_unit", column.sum_unit}});
    }
    return {
        {"program", "quasimc " + std::string(version())},
        {"unit", scene.length_unit()},
        {"axes",
         {{"x", json_vector(axes.inward({1, 0, 0}))},
          {"y", json_vector(axes.inward({0, 1, 0}))},
          {"z", json_vector(axes.inward({0, 0, 1}))}}},
        {"north", json_vector(axes.towards(0, 0))},
        {"middle", json_vector(middle)},
        {"low", json_vector(scene.bounds().low - middle)},
        {"high", json_vector(scene.bounds().high - middle)},
        {"periods", json_periods(scene.cell())},
        {"organs", organs_of(organs)},
        {"sensors", json_sensors(scene, middle)},
        {"columns", list}};
}

std::string window_values(const std::vector<Estimate>& organs) {
    const std::size_t count = organs.size();
    std::vector<float> numbers(4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        numbers[i] = static_cast<float>(organs[i].mean);
        numbers[count + i] = static_cast<float>(organs[i].standard_error);
        numbers[2 * count + i] = static_cast<float>(organs[i].ci95_low);
        numbers[3 * count + i] = static_cast<float>(organs[i].ci95_high);
    }
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)};
}

std::string window_run_head(const RunFile& run) {
    Json head = json_head(run);
    head.update(json_warnings(run));
    return json_text(head);
}

std::string window_light_head(const RunFile& run, const Result& result) {
    const JsonNames names = json_names(run, written_columns(run));
    std::string groups;
    for (std::size_t i = 0; i < result.groups.groups.size(); ++i) {
        groups += (groups.empty() ? "" : ",") + json_group(result.groups, i, names);
    }
    return json_text_with(json_light(run, result), "groups", "[" + groups + "]");
}

std::string window_light_head(
    std::span<const Band> bands, const std::string& length_unit, const Result& result) {
    return json_text(json_light(bands, length_unit, result));
}

}  // namespace quasimc

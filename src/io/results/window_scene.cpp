#include "io/results/window_scene.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "io/results/series_words.h"
#include "io/results/window_shape.h"
#include "io/runfile/units.h"
#include "quasimc/version.h"

namespace quasimc {
namespace {

std::string in_words(std::string_view name) {
    std::string words(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

/// "key": [...], an item for each element.
template <typename List, typename Write>
void json_list(JsonStream& json, std::string_view key, const List& list, const Write& write) {
    json.key(key);
    json.begin_list(kWindowLayout);
    for (const auto& item : list) {
        write(item);
    }
    json.end_list();
}

void json_vector(JsonStream& json, std::string_view key, const Vec3& v) {
    json.key(key);
    json.begin_list(kWindowLayout);
    for (const double x : {v.x, v.y, v.z}) {
        json.number(x);
    }
    json.end_list();
}

/// A key of labels: its values, and which of them each organ has, -1 for none.
struct LabelKey {
    std::vector<std::string> values;
    std::map<std::string, int> numbers;
    std::vector<int> of;
};

std::map<std::string, LabelKey> label_keys(const std::vector<Organ>& organs) {
    std::map<std::string, LabelKey> keys;
    for (std::size_t i = 0; i < organs.size(); ++i) {
        for (const auto& [name, value] : organs[i].labels) {
            LabelKey& key = keys[name];
            key.of.resize(organs.size(), -1);
            const auto [place, is_new] =
                key.numbers.try_emplace(value, static_cast<int>(key.values.size()));
            if (is_new) {
                key.values.push_back(value);
            }
            key.of[i] = place->second;
        }
    }
    return keys;
}

void json_labels(JsonStream& json, const std::vector<Organ>& organs) {
    json.key("labels");
    json.begin_object(kWindowLayout);
    for (const auto& [name, key] : label_keys(organs)) {
        json.key(name);
        json.begin_object(kWindowLayout);
        json_list(json, "values", key.values, [&](const std::string& value) { json.text(value); });
        json_list(json, "of", key.of, [&](int number) { json.integer(number); });
        json.end_object();
    }
    json.end_object();
}

/// Ids and names stand there only if they tell more than the place in the list does; "organ 7" is
/// what the page calls organ 7 that has no name.
void json_organs(JsonStream& json, const std::vector<Organ>& organs) {
    json.key("organs");
    json.begin_object(kWindowLayout);
    json.count("count", organs.size());
    const auto is_counted = [&organs](const Organ& o) { return o.id == &o - organs.data() + 1; };
    if (!std::all_of(organs.begin(), organs.end(), is_counted)) {
        // A number may be more than one of the page holds.
        json_list(json, "id", organs, [&](const Organ& o) { json.text(std::to_string(o.id)); });
    }
    const auto is_named = [](const Organ& o) {
        return !o.name.empty() && o.name != "organ " + std::to_string(o.id);
    };
    if (std::any_of(organs.begin(), organs.end(), is_named)) {
        json_list(json, "name", organs, [&](const Organ& o) { json.text(o.name); });
    }
    json.key("ground");
    json.begin_list(kWindowLayout);
    for (std::size_t i = 0; i < organs.size(); ++i) {
        if (organs[i].is_ground) {
            json.integer(static_cast<std::int64_t>(i));
        }
    }
    json.end_list();
    json_labels(json, organs);
    json.end_object();
}

}  // namespace

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
                {{name, band.name}, name, in_words(name), band.name, unit, summed_unit(unit).name});
        }
    }
    // What reads first is what is asked for most: light absorbed per area.
    std::stable_partition(columns.begin(), columns.end(), [](const WindowColumn& column) {
        return column.quantity == "absorbed_flux_density";
    });
    columns.push_back({{"sunlit_fraction"}, "sunlit_fraction", "sunlit fraction", "", "", ""});
    for (const std::string& ratio : ratios) {
        columns.push_back({{"ratios", ratio}, ratio, ratio, "", "", ""});
    }
    return columns;
}

void json_window_scene(
    JsonStream& json, const Scene& scene, const std::vector<WindowColumn>& columns) {
    const Orientation& axes = scene.orientation();
    const Vec3 middle = window_middle(scene);
    json.text("program", std::string("quasimc ") + std::string(version()));
    json.text("unit", scene.length_unit());
    json.key("axes");
    json.begin_object(kWindowLayout);
    json_vector(json, "x", axes.inward({1, 0, 0}));
    json_vector(json, "y", axes.inward({0, 1, 0}));
    json_vector(json, "z", axes.inward({0, 0, 1}));
    json.end_object();
    json_vector(json, "north", axes.towards(0, 0));
    json_vector(json, "middle", middle);
    json_vector(json, "low", scene.bounds().low - middle);
    json_vector(json, "high", scene.bounds().high - middle);
    json_organs(json, scene.organs());
    json_list(json, "columns", columns, [&](const WindowColumn& column) {
        json.begin_object(kWindowLayout);
        json.text("quantity", column.quantity);
        json.text("name", column.name);
        json.text("band", column.band);
        json.text("unit", column.unit);
        json.text("sum_unit", column.sum_unit);
        json.end_object();
    });
}

}  // namespace quasimc

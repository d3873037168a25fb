#include "io/results/window_data.h"

#include <algorithm>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "io/results/read_columns.h"
#include "io/results/series_words.h"
#include "io/runfile/units.h"
#include "quasimc/version.h"
#include "scene/scene.h"
#include "sources/source.h"

namespace quasimc {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// A kind of number, and where it stands in the result.
struct ColumnKind {
    std::vector<std::string> path;
    std::string name, band, unit, sum_unit;
};

std::string in_words(std::string_view name) {
    std::string words(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

std::vector<ColumnKind> column_kinds(const RunFile& run) {
    std::vector<ColumnKind> kinds;
    for (const QuantityEntry& entry : quantity_table()) {
        for (const Band& band : run.scene.bands()) {
            const std::string unit = unit_of(entry, band, run.scene.length_unit());
            kinds.push_back(
                {{std::string(entry.name), band.name},
                 in_words(entry.name),
                 band.name,
                 unit,
                 summed_unit(unit).name});
        }
    }
    // What reads first is what is asked for most: light absorbed per area.
    std::stable_partition(kinds.begin(), kinds.end(), [](const ColumnKind& kind) {
        return kind.path.front() == "absorbed_flux_density";
    });
    kinds.push_back({{"sunlit_fraction"}, "sunlit fraction", "", "", ""});
    for (const std::string& ratio : run.spec.ratios) {
        kinds.push_back({{"ratios", ratio}, ratio, "", "", ""});
    }
    return kinds;
}

OrderedJson to_json(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// Each key of labels: its values, and which of them each organ has, -1 for none.
OrderedJson labels_json(const std::vector<Organ>& organs) {
    struct Key {
        std::vector<std::string> values;
        std::map<std::string, int> numbers;
        std::vector<int> of;
    };
    std::map<std::string, Key> keys;
    for (std::size_t i = 0; i < organs.size(); ++i) {
        for (const auto& [name, value] : organs[i].labels) {
            Key& key = keys[name];
            key.of.resize(organs.size(), -1);
            const auto [place, is_new] =
                key.numbers.try_emplace(value, static_cast<int>(key.values.size()));
            if (is_new) {
                key.values.push_back(value);
            }
            key.of[i] = place->second;
        }
    }
    OrderedJson json = OrderedJson::object();
    for (auto& [name, key] : keys) {
        json[name] = {{"values", std::move(key.values)}, {"of", std::move(key.of)}};
    }
    return json;
}

OrderedJson organs_json(const std::vector<Organ>& organs) {
    OrderedJson ids = OrderedJson::array(), names = ids, areas = ids, triangles = ids, ground = ids;
    for (const Organ& organ : organs) {
        ids.push_back(std::to_string(organ.id));  // may be more than a number of the page holds
        names.push_back(organ.name);
        areas.push_back(organ.area);
        triangles.push_back(organ.triangle_count);
        ground.push_back(organ.is_ground ? 1 : 0);
    }
    return {{"id", std::move(ids)},        {"name", std::move(names)},
            {"area", std::move(areas)},    {"triangles", std::move(triangles)},
            {"ground", std::move(ground)}, {"labels", labels_json(organs)}};
}

OrderedJson suns_json(const Sources& sources) {
    OrderedJson suns = OrderedJson::array();
    for (const auto& source : sources) {
        if (source->is_sun()) {
            suns.push_back(to_json(source->illuminate({}, 0.5, 0.5).to_light));
        }
    }
    return suns;
}

/// Towards the suns of a time.
OrderedJson suns_at(const RunFile& run, const ResultTime& time) {
    if (!run.series) {
        return suns_json(run.sources);
    }
    for (std::size_t i = 0; time.part == "moments" && i < run.series->notes.size(); ++i) {
        if (run.series->notes[i].time == time.label) {
            return suns_json(run.series->time_steps[i].sources);
        }
    }
    return OrderedJson::array();
}

void append_floats(std::string& bytes, const std::vector<float>& numbers) {
    bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
}

/// Corners about the middle, in the order of organs.
std::string positions_of(const Scene& scene, const Vec3& middle) {
    std::vector<float> numbers;
    numbers.reserve(9 * scene.triangle_count());
    for (const Organ& organ : scene.organs()) {
        for (const Triangle& triangle : scene.triangles_of(organ)) {
            for (const Vec3& corner : triangle) {
                const Vec3 p = corner - middle;
                numbers.insert(
                    numbers.end(),
                    {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
            }
        }
    }
    std::string bytes;
    append_floats(bytes, numbers);
    return bytes;
}

OrderedJson columns_json(const std::vector<ColumnKind>& kinds) {
    OrderedJson columns = OrderedJson::array();
    for (const ColumnKind& kind : kinds) {
        columns.push_back(
            {{"quantity", kind.path.back() == kind.band ? kind.path.front() : kind.path.back()},
             {"name", kind.name},
             {"band", kind.band},
             {"unit", kind.unit},
             {"sum_unit", kind.sum_unit}});
    }
    return columns;
}

/// The times, each with the number of the values of every column, -1 where there are none.
OrderedJson times_json(const RunFile& run, const ResultColumns& result, WindowData& data) {
    OrderedJson times = OrderedJson::array();
    for (const ResultTime& time : result.times) {
        OrderedJson numbers = OrderedJson::array();
        for (const OrganColumn& column : time.columns) {
            numbers.push_back(column.mean.empty() ? -1 : static_cast<int>(data.values.size()));
            if (column.mean.empty()) {
                continue;
            }
            std::string& bytes = data.values.emplace_back();
            append_floats(bytes, column.mean);
            append_floats(bytes, column.standard_error);
            append_floats(bytes, column.low);
            append_floats(bytes, column.high);
        }
        times.push_back(
            {{"part", time.part},
             {"index", time.index},
             {"label", time.label},
             {"suns", suns_at(run, time)},
             {"values", std::move(numbers)}});
    }
    return times;
}

}  // namespace

std::size_t WindowData::bytes() const {
    std::size_t sum = json.size() + positions.size();
    for (const std::string& each : values) {
        sum += each.size();
    }
    return sum;
}

WindowData make_window_data(
    const RunFile& run, const std::string& result_text, const std::string& path) {
    const Scene& scene = run.scene;
    const std::vector<ColumnKind> kinds = column_kinds(run);
    std::vector<std::vector<std::string>> names;
    names.reserve(kinds.size());
    for (const ColumnKind& kind : kinds) {
        names.push_back(kind.path);
    }
    const ResultColumns result = read_columns(
        result_text, path, names, scene.organs().size(),
        run.sweep ? std::optional(run.point) : std::nullopt);
    WindowData data;
    const Orientation& axes = scene.orientation();
    const Vec3 middle = 0.5 * (scene.bounds().low + scene.bounds().high);
    data.positions = positions_of(scene, middle);
    OrderedJson json = {
        {"head", OrderedJson::parse(result.head)},
        {"title", run.title.empty() ? run.path : run.title},
        {"program", std::string("quasimc ") + std::string(version())},
        {"unit", scene.length_unit()},
        {"axes",
         {{"x", to_json(axes.inward({1, 0, 0}))},
          {"y", to_json(axes.inward({0, 1, 0}))},
          {"z", to_json(axes.inward({0, 0, 1}))}}},
        {"north", to_json(axes.towards(0, 0))},
        {"middle", to_json(middle)},
        {"low", to_json(scene.bounds().low - middle)},
        {"high", to_json(scene.bounds().high - middle)},
        {"organs", organs_json(scene.organs())},
        {"columns", columns_json(kinds)},
        {"times", times_json(run, result, data)}};
    if (data.values.empty()) {
        throw InputError(
            {{path, "holds no light of organs", "the run did not write it, or was never finished",
              "look at [output] in the run file"}});
    }
    data.json = json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    return data;
}

}  // namespace quasimc

#include "window/window_data.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "quasimc/error.h"
#include "resultio/describe_result.h"
#include "resultio/json_parts.h"
#include "resultio/read_rows.h"
#include "window/window_difference.h"
#include "window/window_organs.h"
#include "window/window_parts.h"
#include "window/window_shape.h"

namespace quasimc {
namespace {

/// The sources of a time step; none for a sum over times.
const Sources& lights_at(const RunFile& run, const RowsPosition& position) {
    if (!run.series) {
        return run.sources;
    }
    for (std::size_t i = 0; position.part == "time_steps" && i < run.series->notes.size(); ++i) {
        if (run.series->notes[i].time == position.label) {
            return run.series->time_steps[i].sources;
        }
    }
    static const Sources kNone;
    return kNone;
}

/// The indices of the values of columns, which are added; -1 where there are none.
std::vector<int> add_values(WindowData& data, const RowColumns& columns) {
    std::vector<int> indices;
    for (const std::vector<Estimate>& column : columns) {
        indices.push_back(column.empty() ? -1 : static_cast<int>(data.values.size()));
        if (!column.empty()) {
            data.values.push_back(window_values(column));
        }
    }
    return indices;
}

/// A time step, with the index of the values of every column.
Json add_time(
    WindowData& data,
    const RunFile& run,
    const WindowDifference* difference,
    const PlacedRows& rows) {
    Json time = {
        {"part", rows.position.part},
        {"index", rows.position.index},
        {"label", rows.position.label}};
    time.update(json_lights(lights_at(run, rows.position), window_middle(run.scene)));
    if (difference != nullptr) {
        time["minus"] = add_values(data, difference->of(rows.position, rows.columns));
    }
    std::vector<int> indices = add_values(data, rows.columns);
    time["values"] = indices;
    data.value_index.push_back(std::move(indices));
    return time;
}

/// The values of every point, by key.
Json json_points(const std::vector<SweepPoint>& points) {
    Json all = Json::array();
    for (const SweepPoint& point : points) {
        Json& values = all.emplace_back(Json::object());
        for (const SweptValue& value : point.values) {
            values[value.key] = value.text;
        }
    }
    return all;
}

/// Whether any time has a column in both results.
bool has_difference(const Json& times) {
    return std::any_of(times.begin(), times.end(), [](const Json& time) {
        const Json& columns = time["minus"];
        return std::any_of(columns.begin(), columns.end(), [](const Json& i) { return i >= 0; });
    });
}

}  // namespace

std::size_t WindowData::bytes() const {
    std::size_t sum = json.size() + shape.size();
    for (const std::string& each : values) {
        sum += each.size();
    }
    return sum;
}

std::string WindowData::course(std::size_t column, std::size_t organ) const {
    constexpr std::size_t kNumbers = 4;
    std::string bytes;
    for (const std::vector<int>& indices : value_index) {
        if (column >= indices.size()) {
            return {};
        }
        std::string numbers(kNumbers * sizeof(float), '\0');
        if (indices[column] >= 0) {
            const std::string& all = values[static_cast<std::size_t>(indices[column])];
            const std::size_t organs = all.size() / numbers.size();
            if (organ >= organs) {
                return {};
            }
            for (std::size_t i = 0; i < kNumbers; ++i) {
                const std::size_t from = (i * organs + organ) * sizeof(float);
                all.copy(numbers.data() + i * sizeof(float), sizeof(float), from);
            }
        }
        bytes += numbers;
    }
    return bytes;
}

WindowData make_window_data(const ReadResult& result, const ReadResult* minus) {
    const RunFile& run = result.run;
    const Scene& scene = run.scene;
    const std::vector<WindowColumn> columns =
        window_columns(scene.bands(), scene.length_unit(), run.spec.ratios);
    const RowsQuery query = window_query(run, columns);
    const WindowOrgans organs(scene);
    std::optional<WindowDifference> difference;
    if (minus != nullptr) {
        difference.emplace(organs, columns, *minus);
    }
    WindowData data;
    data.shape = window_shape(scene);
    Json times = Json::array();
    const auto take = [&](const PlacedRows& rows) {
        times.push_back(add_time(data, run, difference ? &*difference : nullptr, rows));
    };
    Node head = read_window_rows(result.text, result.path, query, organs, take);
    head = only_point(std::move(head), query.point, result.path);
    if (data.values.empty()) {
        throw InputError(
            {{result.path, "contains no light of organs",
              "the run did not write it, or was not completed", "check [output] in the run file"}});
    }
    if (difference && !has_difference(times)) {
        throw InputError(
            {{minus->path, "has no time or no quantity of the first result",
              "times are matched by their labels", "choose results of the same times and bands"}});
    }
    Json all = json_window_scene(scene, organs, columns);
    all["title"] = title_of(run);
    all["head"] = json_value(head);
    all["times"] = std::move(times);
    if (difference) {
        all["minus"] = difference->json();
    }
    if (run.sweep && result.has_all_points) {
        all["sweep"] = {{"point", run.point}, {"points", json_points(*run.sweep)}};
    }
    data.json = json_text(all);
    return data;
}

}  // namespace quasimc

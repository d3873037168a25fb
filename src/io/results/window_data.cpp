#include "io/results/window_data.h"

#include <optional>
#include <utility>

#include "io/results/json_stream.h"
#include "io/results/read_columns.h"
#include "io/results/window_lights.h"
#include "io/results/window_scene.h"
#include "io/results/window_shape.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

/// Of a time; a sum over times has none of its own.
WindowLights lights_at(const RunFile& run, const ResultTime& time) {
    if (!run.series) {
        return window_lights(run.sources);
    }
    for (std::size_t i = 0; time.part == "moments" && i < run.series->notes.size(); ++i) {
        if (run.series->notes[i].time == time.label) {
            return window_lights(run.series->time_steps[i].sources);
        }
    }
    return {};
}

void append_floats(std::string& bytes, const std::vector<float>& numbers) {
    bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
}

/// The times, each with the number of the values of every column, -1 where there are none.
void json_times(
    JsonStream& json, const RunFile& run, const ResultColumns& result, WindowData& data) {
    json.key("times");
    json.begin_list(kWindowLayout);
    for (const ResultTime& time : result.times) {
        json.begin_object(kWindowLayout);
        json.text("part", time.part);
        json.count("index", time.index);
        json.text("label", time.label);
        json_lights(json, lights_at(run, time), window_middle(run.scene));
        json.key("values");
        json.begin_list(kWindowLayout);
        for (const OrganColumn& column : time.columns) {
            json.integer(column.mean.empty() ? -1 : static_cast<std::int64_t>(data.values.size()));
            if (column.mean.empty()) {
                continue;
            }
            std::string& bytes = data.values.emplace_back();
            append_floats(bytes, column.mean);
            append_floats(bytes, column.standard_error);
            append_floats(bytes, column.low);
            append_floats(bytes, column.high);
        }
        json.end_list();
        json.end_object();
    }
    json.end_list();
}

}  // namespace

std::size_t WindowData::bytes() const {
    std::size_t sum = json.size() + shape.size();
    for (const std::string& each : values) {
        sum += each.size();
    }
    return sum;
}

WindowData make_window_data(
    const RunFile& run, const std::string& result_text, const std::string& path) {
    const Scene& scene = run.scene;
    const std::vector<WindowColumn> columns =
        window_columns(scene.bands(), scene.length_unit(), run.spec.ratios);
    std::vector<std::vector<std::string>> names;
    names.reserve(columns.size());
    for (const WindowColumn& column : columns) {
        names.push_back(column.path);
    }
    const ResultColumns result = read_columns(
        result_text, path, names, scene.organs().size(),
        run.sweep ? std::optional(run.point) : std::nullopt);
    WindowData data;
    data.shape = window_shape(scene);
    JsonStream json;
    json.begin_object(kWindowLayout);
    json.key("head");
    json.raw(result.head);
    json.text("title", run.title.empty() ? run.path : run.title);
    json_window_scene(json, scene, columns);
    json_times(json, run, result, data);
    json.end_object();
    if (data.values.empty()) {
        throw InputError(
            {{path, "holds no light of organs", "the run did not write it, or was never finished",
              "look at [output] in the run file"}});
    }
    data.json = json.take();
    return data;
}

}  // namespace quasimc

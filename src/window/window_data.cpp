#include "window/window_data.h"

#include <algorithm>
#include <deque>
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

/// The weights of the points in sums.
Json json_weights(const std::vector<SweepPoint>& points) {
    Json all = Json::array();
    for (const SweepPoint& point : points) {
        all.push_back(point.weight);
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

/// Collects the data of a result, or of a point of a sweep.
class WindowDataBuilder {
  public:
    /// @param path  for messages
    /// @param minus  see make_window_data()
    WindowDataBuilder(const RunFile& run, const std::string& path, const ReadResult* minus)
        : run_(run),
          path_(path),
          minus_(minus),
          columns_(window_columns(run.scene.bands(), run.scene.length_unit(), run.spec.ratios)),
          organs_(run.scene) {
        if (minus != nullptr) {
            difference_.emplace(organs_, columns_, *minus);
        }
        data_.shape = window_shape(run.scene);
    }

    [[nodiscard]] const WindowOrgans& organs() const { return organs_; }
    [[nodiscard]] RowsQuery query() const { return window_query(run_, columns_); }

    /// Adds a time step, with the index of the values of every column.
    void add(const PlacedRows& rows) {
        Json time = {
            {"part", rows.position.part},
            {"index", rows.position.index},
            {"label", rows.position.label}};
        time.update(json_lights(lights_at(run_, rows.position), window_middle(run_.scene)));
        if (difference_) {
            time["minus"] = add_values(data_, difference_->of(rows.position, rows.columns));
        }
        std::vector<int> indices = add_values(data_, rows.columns);
        time["values"] = indices;
        data_.value_index.push_back(std::move(indices));
        times_.push_back(std::move(time));
    }

    /// @param rest  the result without its rows
    /// @param has_all_points  whether the page also has the other points of its sweep
    [[nodiscard]] WindowData data(const Node& rest, bool has_all_points) {
        check();
        Json all = json_window_scene(run_.scene, organs_, columns_);
        all["title"] = title_of(run_);
        all["head"] = json_value(only_point(rest, query().point, path_));
        all["times"] = std::move(times_);
        if (difference_) {
            all["minus"] = difference_->json();
        }
        if (run_.sweep && has_all_points) {
            all["sweep"] = {
                {"point", run_.point},
                {"points", json_points(*run_.sweep)},
                {"weights", json_weights(*run_.sweep)}};
        }
        data_.json = json_text(all);
        return std::move(data_);
    }

  private:
    void check() const {
        if (data_.values.empty()) {
            throw InputError(
                {{path_, "contains no light of organs",
                  "the run did not write it, or was not completed",
                  "check [output] in the run file"}});
        }
        if (difference_ && !has_difference(times_)) {
            throw InputError(
                {{minus_->path, "has no time or no quantity of the first result",
                  "times are matched by their labels",
                  "choose results of the same times and bands"}});
        }
    }

    const RunFile& run_;
    const std::string& path_;
    const ReadResult* minus_;
    const std::vector<WindowColumn> columns_;
    const WindowOrgans organs_;
    std::optional<WindowDifference> difference_;
    WindowData data_;
    Json times_ = Json::array();
};

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
    WindowDataBuilder builder(result.run, result.path, minus);
    const Node rest = read_window_rows(
        result.text, result.path, builder.query(), builder.organs(),
        [&](const PlacedRows& rows) { builder.add(rows); });
    return builder.data(rest, false);
}

std::vector<WindowData> make_window_data(
    const std::vector<RunFile>& runs, const std::string& text, const std::string& path) {
    std::deque<WindowDataBuilder> builders;
    for (const RunFile& run : runs) {
        builders.emplace_back(run, path, nullptr);
    }
    RowsQuery query = builders.front().query();
    query.point.reset();
    const Node rest = read_window_rows(
        text, path, query,
        [&](std::size_t point) -> const WindowOrgans& { return builders.at(point).organs(); },
        [&](const PlacedRows& rows) { builders.at(rows.position.point).add(rows); });
    std::vector<WindowData> all;
    all.reserve(builders.size());
    for (WindowDataBuilder& builder : builders) {
        all.push_back(builder.data(rest, true));
    }
    return all;
}

}  // namespace quasimc

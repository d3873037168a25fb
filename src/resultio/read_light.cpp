#include "resultio/read_light.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "base/text.h"
#include "quasimc/error.h"
#include "resultio/read_controls.h"
#include "resultio/read_nodes.h"
#include "resultio/read_rows.h"
#include "resultio/stored_columns.h"
#include "results/evaluate.h"

namespace quasimc {
namespace {

/// The values of detectors, NaN where they are missing.
/// @param rest  the result without its rows
std::vector<DetectorResult> read_detectors(
    const Node& rest, const RowsPosition& position, const RunFile& run) {
    const Node* at = run.sweep ? item_at(rest.find("points"), position.point) : &rest;
    at = at != nullptr && run.series ? item_at(at->find("time_steps"), position.index) : at;
    const Node* list = at != nullptr ? at->find("detectors") : nullptr;
    std::vector<DetectorResult> detectors = zero_detectors(run.scene);
    const std::size_t bands = run.scene.bands().size();
    for (std::size_t d = 0; d < detectors.size(); ++d) {
        const Node* detector = item_at(list, d);
        for (std::size_t i = 0; i < detectors[d].values.size(); ++i) {
            const Node* bin =
                detector != nullptr ? item_at(detector->find("bins"), i / bands) : nullptr;
            detectors[d].values[i] = estimate_in(
                bin != nullptr ? bin->find("flux") : nullptr, run.scene.bands()[i % bands].name);
        }
    }
    return detectors;
}

/// The number of a time or day of the run, from one on.
std::size_t find_label(
    const std::vector<std::string>& labels,
    std::size_t from,
    const RowsPosition& position,
    const std::string& path) {
    const auto found =
        std::find(labels.begin() + static_cast<std::ptrdiff_t>(from), labels.end(), position.label);
    if (found == labels.end()) {
        throw InputError(
            {{path,
              shown(position.label) + " in " + position.part + " is not the next one in the run",
              "time steps must be in the order of the run", ""}});
    }
    return static_cast<std::size_t>(found - labels.begin());
}

/// Reports light in the order of a result.
class LightReader {
  public:
    LightReader(
        std::string_view text,
        const std::string& path,
        const RunFile& run,
        const LightEvents& events)
        : path_(path), run_(run), events_(events), columns_(run), series_(run.series) {
        for (std::size_t i = 0; series_ && i < series_->notes.size(); ++i) {
            times_.push_back(series_->notes[i].time);
        }
        if (!run.scene.detectors().empty() || (series_ && !series_->controls.empty())) {
            rest_ = read_rows(text, path, {.rest = RowsQuery::Rest::all}, {});
        }
        read_light_rows(text, path, {.columns = columns_.names()}, [this](LightRows rows) {
            report(std::move(rows));
        });
    }

    [[nodiscard]] bool is_empty() const { return !point_; }

  private:
    /// Reports the light at a position.
    void report(LightRows rows) {
        const RowsPosition& position = rows.position;
        if (rows.organs.empty()) {
            rows.organs.resize(columns_.names().size());
        }
        if (point_ != position.point) {
            point_ = position.point;
            next_time_ = next_day_ = 0;
            events_.on_point(*point_);
            report_controls();
        }
        if (position.part == "days" && series_) {
            const std::size_t day = find_label(series_->days, next_day_, position, path_);
            next_day_ = day + 1;
            events_.on_day(day, sum(std::move(rows)));
        } else if (position.part == "time_steps" && series_) {
            const std::size_t time = find_label(times_, next_time_, position, path_);
            next_time_ = time + 1;
            events_.on_time_step(time, result(std::move(rows)));
        } else if (position.part.empty() && !series_) {
            events_.on_time_step(0, result(std::move(rows)));
        }
    }

    void report_controls() const {
        if (rest_) {
            const auto outcomes = read_controls(*rest_, *point_, run_, path_);
            if (!outcomes.empty()) {
                events_.on_controls(outcomes);
            }
        }
    }

    [[nodiscard]] Result result(LightRows rows) const {
        Result result = columns_.result(rows.organs);
        if (rest_) {
            result.detectors = read_detectors(*rest_, rows.position, run_);
        }
        if (!rows.sensors.empty()) {
            result.sensors =
                std::make_shared<const Result>(columns_.result_of_sensors(std::move(rows.sensors)));
        }
        return result;
    }

    [[nodiscard]] SeriesSum sum(LightRows rows) const {
        SeriesSum sum = columns_.sum(rows.organs);
        if (!rows.sensors.empty()) {
            sum.sensors =
                std::make_shared<const SeriesSum>(columns_.sum_of_sensors(std::move(rows.sensors)));
        }
        return sum;
    }

    const std::string& path_;
    const RunFile& run_;
    const LightEvents& events_;
    const StoredColumns columns_;
    const std::optional<TimeSeries> series_;  // the run may become the next point
    std::vector<std::string> times_;
    std::optional<Node> rest_;
    std::optional<std::size_t> point_;
    std::size_t next_time_ = 0, next_day_ = 0;  // within the point; labels of times may repeat
};

}  // namespace

void read_light(
    std::string_view text, const std::string& path, const RunFile& run, const LightEvents& events) {
    if (LightReader(text, path, run, events).is_empty()) {
        throw InputError(
            {{path, "contains no light of organs or sensors",
              "the run ended before the first result", ""}});
    }
}

}  // namespace quasimc

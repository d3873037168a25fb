#include "resultio/replay_result.h"

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
#include "resultio/read_run_data.h"
#include "resultio/stored_columns.h"
#include "run/zero_result.h"
#include "runfile/run_file.h"
#include "runfile/written.h"
#include "series/trace_spec.h"

namespace quasimc {
namespace {

const Node& or_nothing(const Node* node) {
    static const Node nothing;
    return node != nullptr ? *node : nothing;
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

std::vector<std::string> times_of(const RunFile& run) {
    std::vector<std::string> times;
    for (std::size_t i = 0; run.series && i < run.series->notes.size(); ++i) {
        times.push_back(run.series->notes[i].time);
    }
    return times;
}

/// Reports one run of a result to a writer.
class RunReplay {
  public:
    /// @param stored  the object of the run in the result
    /// @param run     its outcomes of controls are set
    RunReplay(
        const Node& stored,
        std::size_t point,
        const Node& rest,
        const std::string& path,
        RunFile& run,
        OutputWriter& writer)
        : stored_(stored),
          path_(path),
          run_(run),
          writer_(writer),
          columns_(run),
          times_(times_of(run)) {
        if (run.series) {
            run.series->outcomes = read_controls(rest, point, run, path);
            summary_ = read_series_summary(stored);
            const auto& steps = run.series->time_steps;
            has_steps_ = std::all_of(steps.begin(), steps.end(), [](const TimeStep& step) {
                return is_dark(step.sources);
            });
        }
    }

    [[nodiscard]] std::vector<std::vector<std::string>> columns() const { return columns_.names(); }

    void report(LightRows rows) {
        const RowsPosition& position = rows.position;
        if (rows.organs.empty()) {
            rows.organs.resize(columns_.names().size());
        }
        if (position.part == "time_steps" && run_.series) {
            has_steps_ = true;
            const std::size_t time = find_label(times_, next_time_, position, path_);
            add_nights(time);
            next_time_ = time + 1;
            const Node& step = or_nothing(item_at(stored_.find("time_steps"), position.index));
            const Result read = result(std::move(rows), step);
            add_step({time, read, computed_of(step, time)});
        } else if (position.part.empty() && !run_.series) {
            const Result read = result(std::move(rows), stored_);
            add_step({0, read});
        } else if (position.part == "days" && run_.series) {
            add_nights(summary_.completed);
            const std::size_t day = find_label(run_.series->days, next_day_, position, path_);
            next_day_ = day + 1;
            const Node& node = or_nothing(item_at(stored_.find("days"), position.index));
            if (writer_.wants(SeriesPart::days)) {
                writer_.on_day(day, sum(std::move(rows), node));
            }
        } else if (position.part == "total" && run_.series) {
            summary_.total = sum(std::move(rows), or_nothing(stored_.find("total")));
        }
    }

    /// Ends the run. @returns its summary
    [[nodiscard]] const SeriesSummary& end() {
        add_nights(summary_.completed);
        return summary_;
    }

  private:
    void add_step(const TimeStepResult& step) {
        if (writer_.wants(SeriesPart::time_steps)) {
            writer_.on_time_step(step);
        }
    }

    /// Reports the nights up to a time step, which are not written. A file without any time step
    /// has sums alone.
    void add_nights(std::size_t end) {
        for (; has_steps_ && next_time_ < std::min(end, times_.size()); ++next_time_) {
            if (is_dark(run_.series->time_steps[next_time_].sources) &&
                is_selected(run_, next_time_)) {
                add_step({next_time_, night(), next_time_});
            }
        }
    }

    /// The result of a time without light, with the origins of all times.
    const Result& night() {
        if (!night_) {
            const auto& steps = run_.series->time_steps;
            night_ = zero_result(run_.scene, with_origins_of_all(run_.spec, steps));
        }
        return *night_;
    }

    /// The time step that a result was scaled from.
    [[nodiscard]] std::size_t computed_of(const Node& step, std::size_t time) const {
        const std::string name = text_in(step, "computed");
        if (name == times_[time]) {
            return time;
        }
        const auto found = std::find(times_.begin(), times_.end(), name);
        return found == times_.end() ? time : static_cast<std::size_t>(found - times_.begin());
    }

    [[nodiscard]] Result result(LightRows rows, const Node& light) const {
        Result result = columns_.result(rows.organs);
        columns_.add_groups(rows.groups, result);
        read_run_data(light, run_, result);
        if (!rows.sensors.empty()) {
            result.sensors =
                std::make_shared<const Result>(columns_.result_of_sensors(std::move(rows.sensors)));
        }
        return result;
    }

    [[nodiscard]] SeriesSum sum(LightRows rows, const Node& node) const {
        SeriesSum sum = columns_.sum(rows.organs);
        columns_.add_groups(rows.groups, sum);
        sum.seconds = number_in(node, "seconds");
        sum.has_file_units = true;
        sum.canopy = read_canopy(node, run_);
        if (!rows.sensors.empty()) {
            SeriesSum sensors = columns_.sum_of_sensors(std::move(rows.sensors));
            sensors.seconds = sum.seconds;
            sensors.has_file_units = true;
            sum.sensors = std::make_shared<const SeriesSum>(std::move(sensors));
        }
        return sum;
    }

    const Node& stored_;
    const std::string& path_;
    const RunFile& run_;
    OutputWriter& writer_;
    const StoredColumns columns_;
    const std::vector<std::string> times_;
    SeriesSummary summary_;
    std::optional<Result> night_;
    bool has_steps_ = false;                    // whether the file has time steps
    std::size_t next_time_ = 0, next_day_ = 0;  // labels of times may repeat
};

/// Reports the runs of a result to a writer, in the order of the file.
class ResultReplay {
  public:
    ResultReplay(
        std::string_view text,
        const std::string& path,
        RunSweep& runs,
        RunFile& first,
        OutputWriter& writer)
        : rest_(read_rows(text, path, {.rest = RowsQuery::Rest::all}, {})),
          path_(path),
          runs_(runs),
          writer_(writer) {
        begin(first);
        const RowsQuery query{
            .lists = {"organs", "groups", "sensors"}, .columns = replay_->columns()};
        read_light_rows(text, path, query, [this](LightRows rows) { report(std::move(rows)); });
        if (!has_light_) {
            throw InputError(
                {{path, "contains no light of organs or sensors",
                  "the run ended before the first result", ""}});
        }
        writer_.finish(replay_->end());
    }

  private:
    void begin(RunFile& run) {
        const Node& stored = run.sweep ? or_nothing(item_at(rest_.find("points"), point_)) : rest_;
        replay_.emplace(stored, point_, rest_, path_, run, writer_);
    }

    void report(LightRows rows) {
        while (point_ < rows.position.point) {
            next_run();
        }
        has_light_ = has_light_ || !rows.organs.empty() || !rows.sensors.empty();
        replay_->report(std::move(rows));
    }

    void next_run() {
        if (++point_ == runs_.size()) {
            throw InputError({{path_, "has more points than the run", "the file is damaged", ""}});
        }
        auto next = std::make_unique<RunFile>(runs_.take(point_));
        const SeriesSummary summary = replay_->end();
        const auto columns = replay_->columns();
        writer_.next_run(*next, summary);
        run_ = std::move(next);
        begin(*run_);
        if (replay_->columns() != columns) {
            throw InputError(
                {{path_, "the points of the sweep have different origins of light",
                  "the columns of a result are those of its first point", ""}});
        }
    }

    const Node rest_;
    const std::string& path_;
    RunSweep& runs_;
    OutputWriter& writer_;
    std::unique_ptr<RunFile> run_;  // of a point after the first
    std::size_t point_ = 0;
    bool has_light_ = false;
    std::optional<RunReplay> replay_;
};

}  // namespace

void replay_result(
    std::string_view text,
    const std::string& path,
    RunSweep& runs,
    RunFile& first,
    OutputWriter& writer) {
    ResultReplay(text, path, runs, first, writer);
}

}  // namespace quasimc

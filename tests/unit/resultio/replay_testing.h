#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "files/input_files.h"
#include "resultio/replay_result.h"
#include "runfile/run_file.h"
#include "text/document.h"

namespace quasimc::test {

/// A writer whose calls are functions.
struct LightEvents : OutputWriter {
    std::function<void(std::size_t point)> on_point = [](std::size_t) {};
    std::function<void(std::size_t time_step, const Result& result)> on_result =
        [](std::size_t, const Result&) {};
    std::function<void(std::size_t day, const SeriesSum& sum)> on_sum = [](std::size_t,
                                                                           const SeriesSum&) {};
    std::size_t point = 0;
    SeriesSummary summary = {};

    void on_time_step(const TimeStepResult& step) override {
        on_result(step.time_step, step.result);
    }
    void on_day(std::size_t day, const SeriesSum& sum) override { on_sum(day, sum); }
    void next_run(const RunFile& /*run*/, const SeriesSummary& /*summary*/) override {
        on_point(++point);
    }
    void finish(const SeriesSummary& of_last) override { summary = of_last; }
    [[nodiscard]] bool wants(SeriesPart part) const override { return part != SeriesPart::sums; }
};

/// Replays a result of a run file. @param make  makes the writer of its first run
template <typename Make>
void replay_with(const std::string& result, const std::string& run_file, const Make& make) {
    RunSweep runs = read_sweep_document(
        read_toml(run_file, "run.toml"), "run.toml", [] { return InputFiles("/run"); });
    RunFile first = runs.take(0);
    OutputWriter& writer = make(first);
    replay_result(result, "a.json", runs, first, writer);
}

inline void replay(const std::string& result, const std::string& run_file, OutputWriter& writer) {
    replay_with(result, run_file, [&](const RunFile&) -> OutputWriter& { return writer; });
}

}  // namespace quasimc::test

#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>
#include <vector>

#include "quasimc/series.h"

namespace quasimc {

/// What run_series() was asked for; all of it outlives the series.
struct SeriesInput {
    Simulator& simulator;
    const Scene& scene;
    const std::vector<TimeStep>& time_steps;
    const RunSpec& spec;
    const SeriesEvents& events;
    std::stop_token stop;
};

/// What is done with the times of a series, in their order.
struct SeriesSteps {
    /// Computes a time and tells of it. Throws Stopped if there is no result of it.
    std::function<void(std::size_t time_step)> compute;
    /// The last time of a day is done.
    std::function<void(std::size_t last)> finish_day;
};

/// Goes through the times of a series until all are done, or one was stopped: SeriesSummary::done,
/// and why it ended.
/// @throws Stopped  if the first time was
void walk_series(const SeriesInput& input, const SeriesSteps& steps, SeriesSummary& summary);

/// The series ends before all is done; what its caller asked for counts more than its time.
void end_series(StopReason why, SeriesSummary& summary);

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <vector>

#include "quasimc/series.h"

namespace quasimc {

/// Input of run_series(); all of it outlives the series.
struct SeriesInput {
    Simulator& simulator;
    const Scene& scene;
    const std::vector<TimeStep>& time_steps;
    const RunSpec& spec;
    const RunControl& control;
    bool is_last = false;  ///< the last series of the simulator
};

/// Computes the time steps of a series and their sums.
class SeriesSteps {
  public:
    virtual ~SeriesSteps() = default;
    /// Computes a time step and reports it. Throws Stopped if it has no result.
    virtual void compute(std::size_t time_step) = 0;
    /// Called after the last time step of a day.
    virtual void finish_day(std::size_t last) = 0;

  protected:
    SeriesSteps() = default;
};

/// Computes the time steps of a series until all are complete, or one was stopped: sets
/// SeriesSummary::completed, and why it ended.
/// @throws Stopped  if the first time step was stopped
void walk_series(const SeriesInput& input, SeriesSteps& steps, SeriesSummary& summary);

/// Ends a series before it is complete; a stop by the caller takes precedence over the time limit.
void end_series(StopReason why, SeriesSummary& summary);

/// Whether some listener requests a part of a series.
[[nodiscard]] bool is_requested(SeriesPart part, const RunControl& control);
/// Reports a time step, or the sum over a day, to the listeners that request it.
void report_time_step(const RunControl& control, const TimeStepResult& step);
void report_day(const RunControl& control, std::size_t day, const SeriesSum& sum);
void report_sums(const RunControl& control, const SeriesSums& sums);

}  // namespace quasimc

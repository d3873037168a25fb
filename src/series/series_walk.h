#pragma once

#include <cstddef>
#include <vector>

#include "quasimc/series.h"

namespace quasimc {

/// What run_series() was asked for; all of it outlives the series.
struct SeriesInput {
    Simulator& simulator;
    const Scene& scene;
    const std::vector<TimeStep>& time_steps;
    const RunSpec& spec;
    const RunControl& control;
    bool is_last = false;  ///< of the simulator
};

/// Computes the times of a series and their sums.
class SeriesSteps {
  public:
    virtual ~SeriesSteps() = default;
    /// Computes a time and reports it. Throws Stopped if there is no result of it.
    virtual void compute(std::size_t time_step) = 0;
    /// The last time of a day is done.
    virtual void finish_day(std::size_t last) = 0;

  protected:
    SeriesSteps() = default;
};

/// Goes through the times of a series until all are done, or one was stopped: SeriesSummary::done,
/// and why it ended.
/// @throws Stopped  if the first time was
void walk_series(const SeriesInput& input, SeriesSteps& steps, SeriesSummary& summary);

/// The series ends before all is done; what its caller asked for counts more than its time.
void end_series(StopReason why, SeriesSummary& summary);

/// Whether a part of a series is to be computed.
[[nodiscard]] bool is_wanted(SeriesPart part, const RunControl& control);
/// Reports a time, or the sum over a day, to the listeners that want it.
void report_time_step(const RunControl& control, const TimeStepResult& step);
void report_day(const RunControl& control, std::size_t day, const SeriesSum& sum);

}  // namespace quasimc

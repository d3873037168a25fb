#pragma once

// What a run reports while it is computed.

#include <cstddef>

#include "quasimc/result.h"

namespace quasimc {

struct SeriesSum;      // quasimc/series.h
struct SeriesSummary;  // quasimc/series.h

/// How far a run is.
struct Progress {
    double fraction = 0;            ///< of the current plan, 0..1
    double seconds = 0;             ///< so far
    double expected_seconds = 0;    ///< in all; grows when a target needs more rounds
    double fraction_at_target = 0;  ///< of the organs, after the last round; 0 without a target
};

/// The result of one time of a series.
struct TimeStepResult {
    std::size_t time_step = 0;
    const Result& result;
    /// The time step whose computation this result was scaled from; itself if it was computed.
    std::size_t computed = 0;
};

/// Receives the events of runs. All functions are called from the thread that called run(), in the
/// order of the list of listeners; each does nothing unless it is overridden. No listener changes
/// a number.
class RunListener {
  public:
    virtual ~RunListener() = default;

    virtual void on_progress(const Progress& /*progress*/) {}
    virtual void on_time_step(const TimeStepResult& /*step*/) {}
    /// The sum over a day: computed only if some listener wants_days().
    virtual void on_day(std::size_t /*day*/, const SeriesSum& /*sum*/) {}
    virtual void on_end(const SeriesSummary& /*summary*/) {}

    [[nodiscard]] virtual bool wants_days() const { return false; }
    /// Whether SeriesSummary::total is to be computed.
    [[nodiscard]] virtual bool wants_total() const { return false; }

  protected:
    RunListener() = default;
    RunListener(const RunListener&) = default;
    RunListener& operator=(const RunListener&) = default;
};

}  // namespace quasimc

#pragma once

// What a run reports while it is computed.

#include <cstddef>

#include "quasimc/result.h"

namespace quasimc {

struct SeriesSum;      // quasimc/series.h
struct SeriesSummary;  // quasimc/series.h
struct RunSnapshot;    // src/run/run_state.h

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

/// A run that rests between two of its tasks, or between two of its rounds.
class RunSoFar {
  public:
    virtual ~RunSoFar() = default;
    RunSoFar(const RunSoFar&) = delete;
    RunSoFar& operator=(const RunSoFar&) = delete;

    /// Index of the run in its series; 0 for a single run.
    [[nodiscard]] virtual std::size_t time_step() const = 0;
    /// Replicates that result() is made of. Within the first round these are the replicates that
    /// are complete, within later rounds none.
    [[nodiscard]] virtual std::size_t replicates() const = 0;
    /// The result of these replicates, of which there must be two at least. Bit for bit that of a
    /// run of so many replicates and paths.
    [[nodiscard]] virtual Result result() const = 0;
    /// The state of the run, for a checkpoint.
    [[nodiscard]] virtual RunSnapshot snapshot() const = 0;

  protected:
    RunSoFar() = default;
};

/// Receives the events of runs. All functions are called from the thread that called run(), in the
/// order of the list of listeners; each does nothing unless it is overridden. No listener changes
/// a number.
class RunListener {
  public:
    virtual ~RunListener() = default;

    virtual void on_progress(const Progress& /*progress*/) {}
    /// Whether a pause of the run is wanted now. It is asked after every task, and must cost next
    /// to nothing.
    [[nodiscard]] virtual bool wants_pause() { return false; }
    /// The pause that wants_pause() asked for.
    virtual void on_pause(const RunSoFar& /*run*/) {}
    /// A round of a run is complete, and another follows.
    virtual void on_round(const RunSoFar& /*run*/) {}
    /// All rounds of a run are complete, or its time is up.
    virtual void on_last_round(const RunSoFar& /*run*/) {}
    virtual void on_time_step(const TimeStepResult& /*step*/) {}
    /// The sum over a day. It is computed, and reported to listeners that want it, only if some
    /// listener wants_days().
    virtual void on_day(std::size_t /*day*/, const SeriesSum& /*sum*/) {}
    virtual void on_end(const SeriesSummary& /*summary*/) {}

    [[nodiscard]] virtual bool wants_days() const { return false; }
    /// Whether SeriesSummary::total is to be computed. It is as well if there are no listeners.
    [[nodiscard]] virtual bool wants_total() const { return false; }

  protected:
    RunListener() = default;
    RunListener(const RunListener&) = default;
    RunListener& operator=(const RunListener&) = default;
};

}  // namespace quasimc

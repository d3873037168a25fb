#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "quasimc/run.h"
#include "quasimc/series.h"
#include "run/team_runs.h"

namespace quasimc {

/// Of the first process: the runs of a series that all processes of its team trace each by itself.
/// They are those behind the last one that a checkpoint knows; what it knows is traced together.
/// Without a team, or with fewer runs than processes, there are none.
class SharedSeries {
  public:
    /// What it is given must outlive it.
    SharedSeries(
        Simulator& simulator,
        const Scene& scene,
        const std::vector<TimeStep>& time_steps,
        const std::vector<TimeStepPlan>& plans,
        const RunSpec& spec,
        const SeriesEvents& events);

    /// Whether the run of a moment is one of them: it must not be traced together.
    [[nodiscard]] bool has(std::size_t moment) const;
    /// Such a run, as TracedRuns::take; in the order of moments.
    [[nodiscard]] std::optional<TracedRun> take(std::size_t moment, const RunControl& control);

  private:
    const SeriesEvents& events_;
    std::size_t first_ = 0;  // of the moments
    std::vector<TeamJob> jobs_;
    TraceJob trace_;
    std::unique_ptr<TeamRuns> runs_;  // once they have begun
};

/// The checkpoint of a run that goes on from a state that was traced elsewhere.
/// @param kept  where its end is kept; null: nowhere
[[nodiscard]] RunCheckpoint checkpoint_of(std::optional<RunState> state, const RunCheckpoint* kept);

}  // namespace quasimc

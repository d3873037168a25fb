#pragma once

// Distributes the runs of a series, or of all points of a sweep, to the processes of a team by
// index: with n processes each traces every n-th run, and the first process receives their sums in
// order.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quasimc/run.h"
#include "quasimc/series.h"
#include "run/run_team.h"

namespace quasimc {

/// Whether runs can be distributed: each is a single round of paths, and none has a time limit.
[[nodiscard]] bool is_dealt(const RunSpec& spec);

/// The distributed runs, in the first process.
class DealtRuns {
  public:
    /// Starts the others, from a time step of a point on.
    DealtRuns(RunTeam& team, std::uint64_t point, std::uint64_t time_step);
    /// Ends the work of the others.
    ~DealtRuns();
    DealtRuns(const DealtRuns&) = delete;
    DealtRuns& operator=(const DealtRuns&) = delete;

    /// The sums of the next run: traced here, or received.
    /// @throws Stopped  if a stop was requested before
    [[nodiscard]] GivenSums next(
        Simulator& simulator,
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunControl& control);

  private:
    RunTeam& team_;
    std::uint64_t number_ = 0;  // index of the next run
};

/// The distributed runs, in each of the other processes.
class HelpedRuns {
  public:
    explicit HelpedRuns(RunTeam& team) : team_(team) {}
    /// Traces its runs of a series, from a time step on, and sends their sums.
    /// @throws Stopped  if the first process stopped
    void trace(
        const Scene& scene,
        const std::vector<TimeStep>& time_steps,
        const RunSpec& spec,
        std::size_t first);
    /// Reports that no more sums follow, and waits for the first process.
    void end();

  private:
    RunTeam& team_;
    Simulator simulator_;
    std::uint64_t number_ = 0;  // index of the next run
};

}  // namespace quasimc

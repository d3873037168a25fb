#pragma once

// Runs of a series, or of all points of a sweep, that are dealt out to the processes of a team by
// number: each traces every so many-th of them by itself, and the first process gets their sums in
// order.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quasimc/run.h"
#include "quasimc/series.h"
#include "run/run_team.h"

namespace quasimc {

/// Whether runs can be dealt out: each is a single round of paths, and none has a limit of time.
[[nodiscard]] bool is_dealt(const RunSpec& spec);

/// The runs as the first process sees them.
class DealtRuns {
  public:
    /// Lets the others trace theirs, from a time of a point on.
    DealtRuns(RunTeam& team, std::uint64_t point, std::uint64_t time_step);
    /// Ends the work of the others, whatever they are at.
    ~DealtRuns();
    DealtRuns(const DealtRuns&) = delete;
    DealtRuns& operator=(const DealtRuns&) = delete;

    /// The sums of the next run: traced here, or waited for.
    /// @throws Stopped  if a stop was requested before they were there
    [[nodiscard]] GivenSums next(
        Simulator& simulator,
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunControl& control);

  private:
    RunTeam& team_;
    std::uint64_t number_ = 0;  // of the next run
};

/// The runs as each of the other processes sees them.
class HelpedRuns {
  public:
    explicit HelpedRuns(RunTeam& team) : team_(team) {}
    /// Traces its own of the runs of a series, from a time on, and sends their sums.
    /// @throws Stopped  if the first process wants no more
    void trace(
        const Scene& scene,
        const std::vector<TimeStep>& time_steps,
        const RunSpec& spec,
        std::size_t first);
    /// Says that there are no more, and waits until the first process knows it.
    void end();

  private:
    RunTeam& team_;
    Simulator simulator_;
    std::uint64_t number_ = 0;  // of the next run
};

}  // namespace quasimc

#pragma once

// How the runs of a series, or the points of a sweep, are dealt to processes that trace them each
// by itself. Who traces what changes no result: sums are exact.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "quasimc/run_spec.h"
#include "quasimc/series.h"
#include "run/run_team.h"

namespace quasimc {

/// A run, or one of equal parts of it, that one process traces by itself.
struct TeamJob {
    std::uint64_t run = 0;  ///< its number: of a moment of a series, or of a point of a sweep
    std::uint64_t part = 1, parts = 1;  ///< as share_of() has them
    double cost = 0;                    ///< estimated, relative
    friend bool operator==(const TeamJob&, const TeamJob&) = default;
};

/// A run to be dealt.
struct TeamRun {
    std::uint64_t run = 0;
    double cost = 1;
    std::uint64_t most_parts = 1;  ///< that it may be cut into
};

/// Whole runs as long as many are left, and parts of the last ones, so that all processes end at
/// about the same time (guided self-scheduling: Polychronopoulos and Kuck 1987, IEEE Transactions
/// on Computers C-36, 1425-1439).
/// @returns the jobs in the order of runs and parts, which is the order in which they are taken
[[nodiscard]] std::vector<TeamJob> cut_jobs(
    const std::vector<TeamRun>& runs, std::uint64_t processes);

/// The jobs of a series from a moment on; none if it has fewer traces left than there are
/// processes, or a limit of time: such a series is better traced together.
[[nodiscard]] std::vector<TeamJob> jobs_of_series(
    const std::vector<TimeStepPlan>& plans,
    const RunSpec& spec,
    std::size_t first,
    std::uint64_t processes);

/// Whether a run is a single round of paths: it can be cut into parts.
[[nodiscard]] bool is_one_round(const RunSpec& spec);

/// Hands jobs out. Each machine has jobs of its own, of about the same cost together; of these each
/// process takes the next that is left.
class JobQueue {
  public:
    /// All processes of the team make one of the same jobs; it must be done before another one.
    JobQueue(const RunTeam& team, const std::vector<TeamJob>& jobs);
    /// The index of a job that nobody else takes; nothing if none is left for this machine.
    [[nodiscard]] std::optional<std::size_t> next();

  private:
    std::vector<std::size_t> own_;  // of this machine
    TaskRange range_;
    std::uint64_t first_ = 0;  // where the range began
};

}  // namespace quasimc

#pragma once

// Runs that the processes of a team trace each by itself: what they send to the first process, and
// what that makes of it.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/run.h"
#include "quasimc/series.h"
#include "run/run_state.h"
#include "run/run_team.h"
#include "run/team_jobs.h"

namespace quasimc {

/// A run that is done, traced in one or several processes.
struct TracedRun {
    RunState state;          ///< of a run that has no round left
    double cpu_seconds = 0;  ///< of all threads that traced it
};

/// Where the runs of a series come from that are traced elsewhere.
struct TracedRuns {
    /// Waits for the run of a moment. Nothing if it was not traced: the caller must.
    /// @throws Stopped  if a stop was requested before it was there
    std::function<std::optional<TracedRun>(std::size_t moment, const RunControl& control)> take;
};

/// What came of a job: nothing, if it was not traced; the sums of a run of one round, or of a part
/// of it; or the last state of a run of several rounds.
struct TracedJob {
    std::optional<Sums> sums;
    std::optional<RunState> state;
    double seconds = 0, cpu_seconds = 0;

    [[nodiscard]] bool is_traced() const { return sums || state; }
};

/// The same as bytes: without replicates that a part has not traced.
[[nodiscard]] std::string save_job(TracedJob job);
/// @throws std::invalid_argument  if these are not the bytes of a job
[[nodiscard]] TracedJob load_job(std::string_view bytes);

/// The numbers of mail about a job: what came of it, and its state meanwhile.
[[nodiscard]] constexpr std::uint64_t result_number(std::size_t job) {
    return 2 * job;
}
[[nodiscard]] constexpr std::uint64_t state_number(std::size_t job) {
    return 2 * job + 1;
}

using TraceJob = std::function<TracedJob(const TeamJob& job, const RunControl& control)>;

/// Traces a run, or a part of it, for the first process. What this process can't trace, or not in
/// parts, or finds faulty, is left to the first: it is not traced then.
/// @param control  its checkpoint is told of the states of a whole run
/// @throws Stopped  if it was stopped
[[nodiscard]] TracedJob trace_job(
    Simulator& simulator,
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const TeamJob& job,
    const RunControl& control);

/// Traces the jobs of a series. All must outlive it.
[[nodiscard]] TraceJob series_tracer(
    Simulator& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const std::vector<TimeStepPlan>& plans,
    const RunSpec& spec);

/// Of the first process of a team: lets all of them trace runs, and brings together what they send.
class TeamRuns {
  public:
    /// @param order  what lets the others call help_with_runs() with the same jobs
    TeamRuns(
        const RunTeam& team, const TeamOrder& order, std::vector<TeamJob> jobs, TraceJob trace);
    /// Ends the work of the others, whatever they are at.
    ~TeamRuns();
    TeamRuns(const TeamRuns&) = delete;
    TeamRuns& operator=(const TeamRuns&) = delete;

    /// As TracedRuns::take. Runs must be taken in the order of jobs. Traces others meanwhile.
    /// @param control  of the run: its checkpoint keeps what all processes have done of theirs
    [[nodiscard]] std::optional<TracedRun> take(std::uint64_t run, const RunControl& control);

  private:
    [[nodiscard]] TracedJob take_job(std::size_t job, const RunControl& control);
    [[nodiscard]] std::optional<TracedJob> find(std::size_t job);
    [[nodiscard]] TracedJob trace_here(std::size_t job, const RunControl& control);
    void keep_states(const RunControl& control);
    [[nodiscard]] std::size_t moment_of(std::size_t job, const RunControl& control) const;

    const RunTeam& team_;
    std::vector<TeamJob> jobs_;
    TraceJob trace_;
    JobQueue queue_;
    std::map<std::size_t, TracedJob> own_;  // traced here, and not taken yet
    std::set<std::size_t> kept_;            // of these, those that the checkpoint has
    std::size_t next_ = 0;                  // the first job that was not taken
    std::uint64_t run_ = 0;                 // that is taken
};

/// Of the other processes: traces jobs until none is left, or the first process wants no more.
void help_with_runs(const RunTeam& team, const std::vector<TeamJob>& jobs, const TraceJob& trace);

}  // namespace quasimc

#pragma once

// Processes that trace a run together: the first has the run, the others help it. What each traces
// is exact and depends on tasks alone, so that any number of them gives the same bits.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/common_memory.h"
#include "base/executor.h"
#include "quasimc/run.h"
#include "quasimc/series.h"
#include "quasimc/sums.h"
#include "run/kept_caster.h"
#include "scene/scene.h"
#include "solvers/solver.h"

namespace quasimc {

/// What the first process asks of the others: most often to trace tasks of a round with it.
struct TeamOrder {
    std::uint64_t is_end = 0;      ///< nothing more is asked
    std::uint64_t is_prepare = 0;  ///< orders for this moment and these first paths follow
    /// To trace runs each by itself: those of the series from this moment on, or of the sweep from
    /// this point on. 0: all trace one together.
    std::uint64_t is_runs = 0;
    static constexpr std::uint64_t kTimes = 1, kPoints = 2;
    std::uint64_t point = 0;   ///< of a sweep
    std::uint64_t moment = 0;  ///< of its times
    std::uint64_t first_paths = 0;
    Round round = {};
    TaskPosition tasks = {};  ///< done before
};

/// What the processes of a team send to the first one while each traces runs by itself. Each piece
/// of mail has a number; all of one number, before the mail ends, is of one process.
struct TeamMail {
    /// Of the others: sends bytes to the first. Returns while they are on their way, but waits if
    /// more are. What has the same number arrives in the order in which it was sent.
    std::function<void(std::uint64_t number, std::string_view bytes)> send;
    /// Of the others: whether all that was sent has arrived.
    std::function<bool()> has_arrived;
    /// Of the first: what was sent under a number, if it is there.
    std::function<std::optional<std::string>(std::uint64_t number)> receive;
    /// Of the first: lets the others know that it wants no more.
    std::function<void()> close;
    /// Of the others: whether it did.
    std::function<bool()> is_closed;
    /// Of all: returns when no mail is on its way. What was not received is dropped.
    std::function<void()> end;
};

/// The team as one process sees it.
struct RunTeam {
    bool is_first = true;
    std::uint64_t size = 1;                   ///< processes
    std::uint64_t machine = 0, machines = 1;  ///< the own, of all
    TaskTeam tasks;
    TeamMail mail;
    /// Of the first process: tells the others. Of the others: waits for it.
    std::function<TeamOrder(const TeamOrder& order)> order;
    /// Adds to the numbers of the first process those of the others.
    std::function<void(std::vector<std::int64_t>& numbers)> add_up;
    /// Gives the others bytes of the first process. All call it.
    std::function<void(std::string& bytes)> share;
    std::shared_ptr<CommonMemory> memory;  ///< of the processes of this machine; or null
    std::uint64_t point = 0;               ///< that the first process is at
    /// Seconds from one state to the next that a process sends of the run that it traces by itself,
    /// so that a checkpoint has it; nothing: it sends none.
    std::optional<double> keep_every;
};

/// Adds up the bins of all processes, which are of one layout: they are those of the first process
/// then, and nothing in the others. All call it.
void add_up(const RunTeam& team, Sums& sums);

/// A process that helps the first one. Keeps the acceleration structure from run to run.
class TeamHelper {
  public:
    /// Helps with the runs of a series, until an order is for another point, for several points, or
    /// the end: returns it.
    /// @param order  the first one
    [[nodiscard]] TeamOrder help(
        const Scene& scene,
        const std::vector<TimeStep>& time_steps,
        const RunSpec& spec,
        const RunTeam& team,
        TeamOrder order);

  private:
    [[nodiscard]] TeamOrder help_moment(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunTeam& team,
        TeamOrder order);

    Simulator simulator_;  // of runs that it traces by itself
    KeptCaster caster_;
};

}  // namespace quasimc

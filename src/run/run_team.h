#pragma once

// Processes that trace a run together: the first has the run, the others help it. What each traces
// is exact and depends on tasks alone, so that any number of them gives the same bits.

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "base/executor.h"
#include "quasimc/sums.h"
#include "solvers/solver.h"

namespace quasimc {

/// What the first process asks of the others.
struct TeamOrder {
    /// To trace their tasks of a round with it; their own of all runs from here on (dealt_runs.h);
    /// nothing more.
    static constexpr std::uint64_t kTrace = 0, kDealt = 1, kEnd = 2;
    std::uint64_t kind = kTrace;
    std::uint64_t is_prepare = 0;  ///< orders for this moment and these first paths follow
    std::uint64_t point = 0;       ///< of a sweep
    std::uint64_t moment = 0;      ///< of its times
    std::uint64_t first_paths = 0;
    Round round = {};
    TaskPosition tasks = {};  ///< done before
};

/// The team as one process sees it.
struct RunTeam {
    std::uint64_t rank = 0;  ///< 0: the first process
    std::uint64_t size = 1;  ///< processes
    TaskTeam tasks;
    /// Of the first process: tells the others. Of the others: waits for it.
    std::function<TeamOrder(const TeamOrder& order)> order;
    /// Adds to the numbers of the first process those of the others.
    std::function<void(std::vector<std::int64_t>& numbers)> add_up;
    /// Gives the others bytes of the first process. All call it.
    std::function<void(std::string& bytes)> share;
    /// Of the others: sends bytes to the first process, and waits until they are received.
    std::function<void(std::string_view bytes)> send;
    /// Of the first process: waits for what one of the others sends.
    /// @throws Stopped  if a stop was requested before
    std::function<std::string(std::uint64_t rank, const std::stop_token& stop)> receive;
    /// Of the first process: asks the others to give up what they are at.
    std::function<void()> stop;
    /// Of the others: whether it did; and to wait until it does, which ends this.
    std::function<bool()> is_stopped;
    std::function<void()> await_stop;
    std::uint64_t point = 0;  ///< that the first process is at

    [[nodiscard]] bool is_first() const { return rank == 0; }
};

/// Adds up the bins of all processes, which are of one layout: they are those of the first process
/// then, and nothing in the others. All call it.
void add_up(const RunTeam& team, Sums& sums);

}  // namespace quasimc

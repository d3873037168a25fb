#pragma once

// Processes that trace a run together: the first has the run, the others help it. What each traces
// is exact and depends on tasks alone, so that any number of them gives the same bits.

#include <cstdint>
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
    std::uint64_t time_step = 0;   ///< of its times
    std::uint64_t first_paths = 0;
    Round round = {};
    TaskPosition tasks = {};  ///< done before
};

/// The team as one process sees it.
class RunTeam : public TaskTeam {
  public:
    /// Number of this process; 0: the first.
    [[nodiscard]] virtual std::uint64_t rank() const = 0;
    /// Processes.
    [[nodiscard]] virtual std::uint64_t size() const = 0;
    /// Of the first process: tells the others. Of the others: waits for it.
    virtual TeamOrder order(const TeamOrder& order) = 0;
    /// Adds to the numbers of the first process those of the others. All call it.
    virtual void add_up(std::vector<std::int64_t>& numbers) = 0;
    /// Gives the others bytes of the first process. All call it.
    virtual void share_bytes(std::string& bytes) = 0;
    /// Of the others: sends bytes to the first process, and waits until they are received.
    virtual void send(std::string_view bytes) = 0;
    /// Of the first process: waits for what one of the others sends.
    /// @throws Stopped  if a stop was requested before
    [[nodiscard]] virtual std::string receive(std::uint64_t rank, const std::stop_token& stop) = 0;
    /// Of the first process: asks the others to give up what they are at.
    virtual void stop() = 0;
    /// Of the others: whether it did.
    [[nodiscard]] virtual bool is_stopped() = 0;
    /// Of the others: waits until it does, which ends this.
    virtual void await_stop() = 0;

    [[nodiscard]] bool is_first() const { return rank() == 0; }
    [[nodiscard]] Share share() const override { return share_of(rank() + 1, size()); }
};

/// A run that a team traces together, as all of them know it.
struct TeamRun {
    RunTeam* team = nullptr;  ///< null: this process traces alone
    std::uint64_t point = 0;  ///< of a sweep
    std::uint64_t time_step = 0;
};

/// Adds up the bins of all processes, which are of one layout: they are those of the first process
/// then, and nothing in the others. All call it.
void add_up(RunTeam& team, Sums& sums);

}  // namespace quasimc

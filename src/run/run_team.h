#pragma once

// Processes that trace a run together: the first owns the run, the others help. The work of each is
// exact and depends on tasks alone, so that any number of processes gives the same bits.

#include <cstdint>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "base/executor.h"
#include "quasimc/sums.h"
#include "solvers/solver.h"

namespace quasimc {

/// An order of the first process to the others.
struct TeamOrder {
    /// Trace their tasks of a round together; trace their own tasks of all further runs
    /// (dealt_runs.h); end.
    static constexpr std::uint64_t kTrace = 0, kDealt = 1, kEnd = 2;
    std::uint64_t kind = kTrace;
    std::uint64_t is_prepare = 0;  ///< the number of the time step and the first paths follow
    std::uint64_t point = 0;       ///< sweep point
    std::uint64_t time_step = 0;   ///< index in its series
    std::uint64_t first_paths = 0;
    Round round = {};
    TaskPosition tasks = {};  ///< already completed
};

/// The team from the view of one process.
class RunTeam : public TaskTeam {
  public:
    /// Index of this process; 0: the first.
    [[nodiscard]] virtual std::uint64_t rank() const = 0;
    /// Number of processes.
    [[nodiscard]] virtual std::uint64_t size() const = 0;
    /// First process: sends an order to the others. Others: wait for it.
    virtual TeamOrder order(const TeamOrder& order) = 0;
    /// Adds the numbers of the other processes to those of the first. All processes call it.
    virtual void add_up(std::vector<std::int64_t>& numbers) = 0;
    /// Broadcasts bytes of the first process. All processes call it.
    virtual void share_bytes(std::string& bytes) = 0;
    /// Others only: sends bytes to the first process, and waits until they are received.
    virtual void send(std::string_view bytes) = 0;
    /// First process only: waits for a message of one of the others.
    /// @throws Stopped  if a stop is requested meanwhile
    [[nodiscard]] virtual std::string receive(std::uint64_t rank, const std::stop_token& stop) = 0;
    /// First process only: asks the others to abandon their work.
    virtual void stop() = 0;
    /// Others only: whether stop() was called.
    [[nodiscard]] virtual bool is_stopped() = 0;
    /// Others only: waits for stop(), which ends this process's work.
    virtual void await_stop() = 0;

    [[nodiscard]] bool is_first() const { return rank() == 0; }
    [[nodiscard]] Share share() const override { return share_of(rank() + 1, size()); }
};

/// A run that a team traces together.
struct TeamRun {
    RunTeam* team = nullptr;  ///< null: this process works alone
    std::uint64_t point = 0;  ///< sweep point
    std::uint64_t time_step = 0;
};

/// Sums the bins of all processes, which share a layout, into the first process; those of the
/// others become empty. All processes call it.
void add_up(RunTeam& team, Sums& sums);

}  // namespace quasimc

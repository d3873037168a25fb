#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/executor.h"
#include "quasimc/run_spec.h"
#include "quasimc/sums.h"
#include "run/run_team.h"
#include "samplers/sampler.h"
#include "solvers/solver.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Of a round that is not complete: which tasks are done, and all sums so far.
struct PartialRound {
    TaskPosition tasks;
    Sums sums;
};

/// Traces the rounds of a run, and keeps the sums of those that are complete.
class RoundTracer {
  public:
    /// @param spec  its paths do not matter: those of the first round do
    /// @param may_be_stopped  then a second copy of the sums is kept while a round is traced
    RoundTracer(
        const PreparedScene& prepared,
        const Sampler& sampler,
        const RunSpec& spec,
        Executor& executor,
        bool may_be_stopped)
        : prepared_(prepared),
          sampler_(sampler),
          spec_(spec),
          executor_(executor),
          may_be_stopped_(may_be_stopped) {}

    /// A round whose first point is number 0 begins anew: when it is complete, its sums replace all
    /// others.
    /// @throws StopRequested  if it was stopped: the sums are what they were before
    /// @param from  what was done of it before; the tasks behind that are traced
    void trace(const Round& round, std::optional<PartialRound> from = {});
    /// Takes over the sums of rounds that are complete. @param first_paths  of the first of them
    void restore(Sums sums, std::uint64_t first_paths);
    /// Traces rounds together with other processes.
    void set_team(const RunTeam* team, std::uint64_t moment = 0);
    /// Traces tasks of a round that the first process of the team has ordered.
    void help(const TeamOrder& order);
    /// Pauses while rounds are traced.
    struct Watcher {
        std::function<bool()> is_due;  ///< as TaskPauses::is_due; empty: never
        /// Is told of the tasks done, and the sums with them, at a pause that was due for it.
        std::function<void(const Pause& pause, const Sums& partial)> on_pause;
        bool was_due = false;
    };
    void add_watcher(Watcher watcher);

    /// Of the paths of the sums, those that were traced before: by who kept the sums that this
    /// tracer took over. Of a round that was not complete in proportion to its tasks.
    [[nodiscard]] double paths_before() const { return paths_before_; }
    /// That other processes took for tasks of the rounds that are complete, all of their threads.
    [[nodiscard]] double cpu_seconds_of_others() const { return cpu_seconds_of_others_; }
    [[nodiscard]] bool has_sums() const { return done_.has_value(); }
    /// Of the first of the rounds that are complete.
    [[nodiscard]] std::uint64_t first_paths() const { return first_paths_; }
    /// Of the rounds that are complete; there must be one.
    [[nodiscard]] const Sums& sums() const { return *done_; }
    [[nodiscard]] Sums take_sums() && { return std::move(*done_); }
    /// What the units of sums count, of a round.
    [[nodiscard]] std::uint64_t samples_of(const Round& round) const {
        return solver_->samples_of(round);
    }

  private:
    void make_solver_for(std::uint64_t first_paths);
    void solve(const Round& round, Sums& sums);
    [[nodiscard]] bool ask_watchers();
    void tell_watchers(const Pause& pause);
    void add_cpu_seconds(double own);
    void order(const Round& round, const TaskPosition& tasks, std::uint64_t first_paths) const;

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    RunSpec spec_;
    Executor& executor_;
    bool may_be_stopped_;
    std::unique_ptr<Solver> solver_;
    std::optional<Sums> done_;
    std::uint64_t first_paths_ = 0;
    double paths_before_ = 0;
    double cpu_seconds_of_others_ = 0;
    Sums* partial_ = nullptr;  // while a round is traced
    std::vector<Watcher> watchers_;
    const RunTeam* team_ = nullptr;
    std::uint64_t moment_ = 0;
};

}  // namespace quasimc

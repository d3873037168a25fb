#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>

#include "base/executor.h"
#include "quasimc/run_spec.h"
#include "quasimc/sums.h"
#include "run/run_team.h"
#include "samplers/sampler.h"
#include "solvers/solver.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// A round, and where it starts.
struct RoundStart {
    Round round;
    std::uint64_t first_paths = 0;  ///< of the run's first round
    TaskPosition tasks = {};        ///< completed tasks of the round
};

/// Statistics of a solved round.
struct SolvedRound {
    double part_done_before = 0;       ///< fraction of its tasks
    double cpu_seconds_of_others = 0;  ///< all threads of other processes
};

/// Solves the rounds of a run, alone or together with other processes. All rounds share the solver
/// of the first.
class RoundSolver {
  public:
    /// @param spec  its paths are ignored: those of the first round apply
    RoundSolver(
        const PreparedScene& prepared,
        const Sampler& sampler,
        const RunSpec& spec,
        std::stop_token stop,
        const TeamRun& team = {});

    /// The solver of a run with this number of paths in its first round.
    Solver& solver_for(std::uint64_t first_paths);
    /// Empty sums of such a run.
    [[nodiscard]] Sums empty_sums(std::uint64_t first_paths);
    /// Adds the light of a round to sums, that of this process alone.
    /// @param watcher  may be null
    /// @throws StopRequested  if it was stopped: the sums are then invalid
    SolvedRound solve(const RoundStart& start, Sums& sums, TaskWatcher* watcher);

  private:
    void order(const RoundStart& start) const;

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    std::stop_token stop_;
    TeamRun team_;
    std::optional<RunSpec> solved_spec_;  // specification of the solver
    std::unique_ptr<Solver> solver_;
};

}  // namespace quasimc

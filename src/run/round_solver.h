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

/// What is to be traced of a round.
struct RoundStart {
    Round round;
    std::uint64_t first_paths = 0;  ///< of the first round of the run
    TaskPosition tasks = {};        ///< of the round, that are done already
};

/// How a round was solved.
struct SolvedRound {
    double part_done_before = 0;       ///< of its tasks
    double cpu_seconds_of_others = 0;  ///< that other processes took, all of their threads
};

/// Solves the rounds of a run, alone or together with other processes. What a solver makes for the
/// first round serves the others.
class RoundSolver {
  public:
    /// @param spec  its paths do not matter: those of the first round do
    RoundSolver(
        const PreparedScene& prepared,
        const Sampler& sampler,
        const RunSpec& spec,
        std::stop_token stop,
        const TeamRun& team = {});

    /// The solver of a run whose first round has so many paths.
    Solver& solver_for(std::uint64_t first_paths);
    /// Sums of no paths yet of such a run.
    [[nodiscard]] Sums empty_sums(std::uint64_t first_paths);
    /// Adds the light of a round to sums, those of this process alone.
    /// @param watcher  may be null
    /// @throws StopRequested  if it was stopped: the sums are then of no use
    SolvedRound solve(const RoundStart& start, Sums& sums, TaskWatcher* watcher);

  private:
    void order(const RoundStart& start) const;

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    std::stop_token stop_;
    TeamRun team_;
    std::optional<RunSpec> solved_spec_;  // of the solver
    std::unique_ptr<Solver> solver_;
};

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/executor.h"
#include "base/lazy.h"
#include "quasimc/run.h"
#include "run/round_solver.h"
#include "run/run_state.h"
#include "sums/sum_data.h"

namespace quasimc {

/// Constant data of a run while its rounds are traced.
struct RunFacts {
    const PreparedScene& prepared;
    const RunSpec& spec;  ///< planned
    const EvaluationSpec& asked;
    std::size_t time_step = 0;
    Lazy<std::uint64_t> cached_digest = {};

    [[nodiscard]] std::uint64_t digest() const;
};

/// The sums of the completed rounds.
struct DoneRounds {
    Sums sums;
    RoundsState state;
    std::uint64_t first_paths = 0;     ///< of the first round
    double paths_before = 0;           ///< traced before the run was resumed
    double cpu_seconds_of_others = 0;  ///< processor time
};

/// A run between two rounds.
class RunBetweenRounds final : public RunSoFar {
  public:
    RunBetweenRounds(const RunFacts& facts, const DoneRounds& done)
        : RunBetweenRounds(facts, done.sums, done.state, done.first_paths) {}
    RunBetweenRounds(
        const RunFacts& facts,
        const Sums& sums,
        const RoundsState& state,
        std::uint64_t first_paths)
        : facts_(facts), sums_(sums), state_(state), first_paths_(first_paths) {}

    [[nodiscard]] std::size_t time_step() const override { return facts_.time_step; }
    [[nodiscard]] std::size_t replicates() const override { return sums_->replicates.size(); }
    [[nodiscard]] Result result() const override;
    [[nodiscard]] RunSnapshot snapshot() const override;

  private:
    const RunFacts& facts_;
    const Sums& sums_;
    RoundsState state_;
    std::uint64_t first_paths_;
};

/// Calls a function for all listeners.
void report(
    const RunControl& control,
    void (RunListener::*event)(const RunSoFar& run),
    const RunBetweenRounds& run);

/// A round in progress.
struct RoundAtHand {
    const RoundStart& start;
    const DoneRounds* done = nullptr;  ///< the previous rounds; null: no round is complete
    const Sums& sums;                  ///< of all rounds, so far
};

/// A run at a pause within a round.
class RunWithinRound final : public RunSoFar {
  public:
    /// @param samples  of the round (Solver::samples_of)
    RunWithinRound(
        const RunFacts& facts, const RoundAtHand& round, const Pause& pause, std::uint64_t samples)
        : facts_(facts), round_(round), pause_(pause), samples_(samples) {}

    [[nodiscard]] std::size_t time_step() const override { return facts_.time_step; }
    [[nodiscard]] std::size_t replicates() const override;
    [[nodiscard]] Result result() const override;
    [[nodiscard]] RunSnapshot snapshot() const override;

  private:
    const RunFacts& facts_;
    const RoundAtHand& round_;
    Pause pause_;
    std::uint64_t samples_;
};

/// Reports a round in progress to the listeners of its run.
class RoundWatch final : public TaskWatcher {
  public:
    /// @param work  the round's part of all work
    RoundWatch(
        const RunFacts& facts,
        const std::vector<RunListener*>& listeners,
        const RoundAtHand& round,
        RoundSolver& solver,
        Work work,
        double at_target);

    void on_progress(double part) override { work_.report(part, at_target_); }
    [[nodiscard]] bool wants_pause() override;
    void on_pause(const Pause& pause) override;

  private:
    struct Listening {
        RunListener* listener;
        bool waits = false;  ///< for a pause
    };

    const RunFacts& facts_;
    std::vector<Listening> listeners_;
    RoundAtHand round_;
    RoundSolver& solver_;
    Work work_;
    double at_target_;
};

}  // namespace quasimc

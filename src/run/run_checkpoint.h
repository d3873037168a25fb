#pragma once

#include <functional>
#include <optional>

#include "quasimc/run.h"
#include "run/round_tracer.h"
#include "run/rounds.h"
#include "run/run_state.h"

namespace quasimc {

/// Keeps the state of one run where a checkpoint is asked for (RunControl::checkpoint), and lets
/// the run go on from the state that was kept. Without one it does nothing.
class StateKeeper {
  public:
    /// @param spec  of the run, planned
    /// @throws InputError  if the state that was kept is of another run
    StateKeeper(const RunControl& control, const PreparedScene& prepared, const RunSpec& spec);

    /// Goes on from the rounds that were complete, and lets the tracer pause from now on.
    /// @param at_target  what fraction of the organs has reached the target with the tracer's sums
    void begin(Rounds& rounds, RoundTracer& tracer, const std::function<double()>& at_target);
    /// What was done of the round that begins now.
    [[nodiscard]] std::optional<PartialRound> begin_round(const Round& round);
    /// The round is complete.
    void finish_round(const Rounds& rounds, const RoundTracer& tracer);
    /// The run has ended, with the sums of all rounds that are complete.
    void finish(const RoundTracer& tracer);
    /// The run had one round, which was traced elsewhere.
    void finish_given(const Sums& sums);

  private:
    const RunCheckpoint* checkpoint_;
    std::size_t moment_;
    std::optional<RunState> stored_;  // until it was taken over
    RunPosition position_;
};

}  // namespace quasimc

#pragma once

#include <vector>

#include "quasimc/run.h"
#include "run/early_stop.h"
#include "run/run_view.h"
#include "samplers/sampler.h"

namespace quasimc {

/// Input of trace_rounds().
struct RoundsInput {
    const RunFacts& facts;
    const Sampler& sampler;
    const RunControl& control;
    Work work;  ///< all rounds
    Deadline deadline;
    EarlyStop& early;               ///< stops at the latest time of the deadline
    double seconds_after_stop = 0;  ///< see RunRole
    /// Start of the run, and of its first round.
    Deadline::Clock::time_point start, first_round;
};

/// The outcome of the rounds of a run.
struct TracedRounds {
    Sums sums;
    StopReason stop = StopReason::finished;
    double at_target = 0;     ///< RoundErrors::fraction_at_target
    double paths_before = 0;  ///< traced before the run was resumed
    double cpu_seconds_of_others = 0;
    std::vector<RoundErrors> errors = {};  ///< after each round, where several are requested
};

/// Traces rounds until the run is complete.
/// @throws StopRequested  if it was stopped before it had a result
[[nodiscard]] TracedRounds trace_rounds(const RoundsInput& input);

}  // namespace quasimc

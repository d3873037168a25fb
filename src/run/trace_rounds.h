#pragma once

#include <vector>

#include "quasimc/run.h"
#include "run/early_stop.h"
#include "run/run_view.h"
#include "samplers/sampler.h"

namespace quasimc {

/// How the rounds of a run are traced.
struct RoundsInput {
    const RunFacts& facts;
    const Sampler& sampler;
    const RunControl& control;
    Work work;  ///< all rounds
    Deadline deadline;
    EarlyStop& early;               ///< stops at the latest time of the deadline
    double seconds_after_stop = 0;  ///< as RunRole
    /// When the run began, and when its first round begins.
    Deadline::Clock::time_point start, first_round;
};

/// What the rounds of a run have brought.
struct TracedRounds {
    Sums sums;
    StopReason stop = StopReason::finished;
    double at_target = 0;     ///< fraction of the organs
    double paths_before = 0;  ///< traced by the run that this one went on from
    double cpu_seconds_of_others = 0;
    std::vector<RoundErrors> errors = {};  ///< after each round, where several are asked for
};

/// Traces rounds until the run is over.
/// @throws StopRequested  if it was stopped before there was a result
[[nodiscard]] TracedRounds trace_rounds(const RoundsInput& input);

}  // namespace quasimc

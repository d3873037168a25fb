#pragma once

#include "quasimc/run.h"

namespace quasimc {

/// What is to be made of the sums of a run.
[[nodiscard]] EvaluationSpec evaluation_of(
    const Scene& scene, const Sources& sources, const RunSpec& spec);

/// The result of the sums of a run. @throws OutOfMemory
[[nodiscard]] Result make_result(const Sums& sums, const Scene& scene, const EvaluationSpec& asked);
/// The same of sums that are given back as they are read.
[[nodiscard]] Result make_result(Sums&& sums, const Scene& scene, const EvaluationSpec& asked);

}  // namespace quasimc

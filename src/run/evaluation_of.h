#pragma once

#include "quasimc/run.h"

namespace quasimc {

/// How the sums of a run are evaluated.
[[nodiscard]] EvaluationSpec evaluation_of(
    const Scene& scene, const Sources& sources, const RunSpec& spec);

/// The result of the sums of a run. @throws OutOfMemory
[[nodiscard]] Result make_result(const Sums& sums, const Scene& scene, const EvaluationSpec& asked);
/// The result of the sums of a run, which are released as they are read.
[[nodiscard]] Result make_result(Sums&& sums, const Scene& scene, const EvaluationSpec& asked);

}  // namespace quasimc

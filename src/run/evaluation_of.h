#pragma once

#include "quasimc/run.h"

namespace quasimc {

/// What is to be made of the sums of a run.
[[nodiscard]] EvaluationSpec evaluation_of(
    const Scene& scene, const Sources& sources, const RunSpec& spec);

}  // namespace quasimc

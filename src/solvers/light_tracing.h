#pragma once

#include "solvers/catalogue.h"

namespace quasimc {

/// Light tracing: paths start at the sources (docs/theory/light-tracing.md).
[[nodiscard]] std::unique_ptr<Solver> make_light_tracing(const SolverInput& input);

/// Where paths start with light: a unit is the light of one path. A sample is a path.
[[nodiscard]] SumMeaning light_tracing_meaning(const PreparedScene& prepared, const RunSpec& spec);

}  // namespace quasimc

#pragma once

#include "solvers/catalogue.h"

namespace quasimc {

/// Direct light by geometry, and paths from where it falls (docs/theory/first-hits.md). Sums mean
/// the same as those of light tracing.
[[nodiscard]] std::unique_ptr<Solver> make_first_hits(const SolverInput& input);

}  // namespace quasimc

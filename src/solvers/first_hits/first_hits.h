#pragma once

#include "solvers/solver.h"
#include "solvers/sum_meaning.h"

namespace quasimc {

/// Direct light by geometry, and paths from where it falls (docs/theory/first-hits.md).
[[nodiscard]] std::unique_ptr<Solver> make_first_hits(const SolverInput& input);

/// A unit is the light of one path, as in light tracing. Contributions along lines and directions
/// are counted.
[[nodiscard]] SumMeaning first_hits_meaning(const PreparedScene& prepared, const RunSpec& spec);

}  // namespace quasimc

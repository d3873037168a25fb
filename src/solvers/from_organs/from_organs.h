#pragma once

#include "solvers/solver.h"
#include "solvers/sum_meaning.h"

namespace quasimc {

/// Backward tracing: paths start at points on every organ (docs/theory/light-tracing.md).
[[nodiscard]] std::unique_ptr<Solver> make_from_organs(const SolverInput& input);

/// A sum holds, for one region of an organ of area A, A_ref / flux times the mean irradiance, per
/// point; A_ref is the area of all measured organs. A sample is a point of an organ.
[[nodiscard]] SumMeaning from_organs_meaning(const PreparedScene& prepared, const RunSpec& spec);

/// True if a round has at least one point on each organ.
[[nodiscard]] bool do_from_organs_rounds_add_up(const Scene& scene, std::uint64_t first_paths);

}  // namespace quasimc

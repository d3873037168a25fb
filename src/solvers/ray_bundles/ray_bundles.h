#pragma once

#include "quasimc/error.h"
#include "solvers/solver.h"
#include "solvers/sum_meaning.h"

namespace quasimc {

/// All scattered light at once, exchanged along bundles of parallel lines
/// (docs/theory/ray-bundles.md).
[[nodiscard]] std::unique_ptr<Solver> make_ray_bundles(const SolverInput& input);

/// A unit is the light of one path, as in light tracing.
[[nodiscard]] SumMeaning ray_bundles_meaning(const PreparedScene& prepared, const RunSpec& spec);

/// Adds a fault for each material of organs or ground that bundles can't send light on from:
/// surfaces must be matt, or sensors.
void check_matt(const Scene& scene, Faults& faults);

}  // namespace quasimc

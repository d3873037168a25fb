#pragma once

#include "quasimc/error.h"
#include "solvers/solver.h"
#include "solvers/sum_meaning.h"

namespace quasimc {

/// Radiosity along bundles of parallel lines (docs/theory/ray-bundles.md).
[[nodiscard]] std::unique_ptr<Solver> make_ray_bundles(const SolverInput& input);

/// A unit is the light of one path, as in light tracing.
[[nodiscard]] SumMeaning ray_bundles_meaning(const PreparedScene& prepared, const RunSpec& spec);

/// Adds a fault for each material of organs or ground that is neither Lambertian nor a sensor.
void check_diffuse(const Scene& scene, Faults& faults);

}  // namespace quasimc

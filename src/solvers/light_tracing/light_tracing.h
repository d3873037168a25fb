#pragma once

#include "solvers/solver.h"
#include "solvers/sum_meaning.h"

namespace quasimc {

/// Light tracing: paths start at the sources (docs/theory/light-tracing.md).
[[nodiscard]] std::unique_ptr<Solver> make_light_tracing(const SolverInput& input);

/// Where paths start with light: a unit is the light of one path. A sample is a path.
[[nodiscard]] SumMeaning light_tracing_meaning(const PreparedScene& prepared, const RunSpec& spec);

/// Of whole blocks: the rays of a block are cast together.
[[nodiscard]] bool do_light_tracing_rounds_add_up(const Scene& scene, std::uint64_t first_paths);

}  // namespace quasimc

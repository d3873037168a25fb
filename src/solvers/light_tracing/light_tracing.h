#pragma once

#include "solvers/solver.h"
#include "solvers/sum_meaning.h"

namespace quasimc {

/// Light tracing: paths start at the sources (docs/theory/light-tracing.md).
[[nodiscard]] std::unique_ptr<Solver> make_light_tracing(const SolverInput& input);

/// A unit is the light of one path, and a sample is a path.
[[nodiscard]] SumMeaning light_tracing_meaning(const PreparedScene& prepared, const RunSpec& spec);

/// True if rounds consist of whole blocks: the rays of a block are cast together.
[[nodiscard]] bool do_light_tracing_rounds_add_up(const Scene& scene, std::uint64_t first_paths);

}  // namespace quasimc

#pragma once

#include <cstdint>

#include "solvers/solver.h"

namespace quasimc {

/// A hash that differs between runs whose sums must not be added: of the geometry as it is traced,
/// the parameters of optics, sources and detectors, and every option that changes sums (not the
/// number of paths, replicates, threads or a target). Takes time in proportion to the triangles.
[[nodiscard]] std::uint64_t digest_of(const PreparedScene& prepared, const RunSpec& spec);

}  // namespace quasimc

#pragma once

#include <cstdint>

#include "quasimc/result.h"
#include "quasimc/run.h"
#include "scene/scene.h"

// What runs of ray bundles are held to.

namespace quasimc::test {

/// A run of ray bundles, see spec_of.
[[nodiscard]] RunSpec bundles(std::uint64_t paths);

/// Whether two runs of a scene agree on every side of every organ, as an audit has it, and the
/// first is so sure of what organs absorb that this tells: rms of the errors, relative to the mean.
void expect_same(const Scene& scene, const Result& own, const Result& plain, double resolution);

/// Whether 95 % intervals of what organs absorb hold what first hits find under a sun and a sky, in
/// 100 runs of ray bundles, of 8 replicates.
void expect_intervals_hold(const Scene& scene, std::uint64_t paths);

}  // namespace quasimc::test

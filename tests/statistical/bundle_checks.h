#pragma once

#include <cstdint>

#include "quasimc/result.h"
#include "quasimc/run.h"
#include "scene/scene.h"

// Checks of runs of ray bundles.

namespace quasimc::test {

/// A run of ray bundles, see spec_of.
[[nodiscard]] RunSpec bundles(std::uint64_t paths);

/// Checks that two runs of a scene agree on every side of every organ, as in an audit, and that the
/// errors of the first in absorbed light are small enough: rms, relative to the mean.
void expect_same(const Scene& scene, const Result& own, const Result& plain, double resolution);

/// Checks the coverage of 95 % intervals of absorbed light in 100 runs of ray bundles, of 8
/// replicates, under a sun and a sky; the reference are first hits.
void expect_intervals_hold(const Scene& scene, std::uint64_t paths);

}  // namespace quasimc::test

#pragma once

#include <cstdint>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc::test {

/// Leaves in a box: equilateral triangles, centers uniform in the cube [0, side]^3, turned
/// uniformly over all rotations. The same seed gives the same leaves everywhere.
[[nodiscard]] std::vector<Triangle> random_leaves(
    std::size_t count, double edge, double side, std::uint64_t seed);

}  // namespace quasimc::test

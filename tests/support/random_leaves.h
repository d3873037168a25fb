#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc::test {

/// An equilateral triangle about `center`.
/// @param rotation  three numbers in [0, 1): cosine and azimuth of the normal, turn about it;
///                  uniform numbers give uniform rotations
[[nodiscard]] Triangle turned_leaf(Vec3 center, double edge, const std::array<double, 3>& rotation);

/// Leaves in a box: equilateral triangles, centers uniform in the cube [0, side]^3, turned
/// uniformly over all rotations. The same seed gives the same leaves everywhere.
[[nodiscard]] std::vector<Triangle> random_leaves(
    std::size_t count, double edge, double side, std::uint64_t seed);

}  // namespace quasimc::test

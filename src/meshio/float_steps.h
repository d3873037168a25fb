#pragma once

#include <span>
#include <string>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

/// Says that coordinates are rounded to single precision, and too coarsely for the triangles: the
/// step of the coordinates exceeds a hundredth of the median triangle's height. "" if they are not.
/// It looks at the numbers, not at the format: those of a text may have been rounded before.
/// @param parts  faces, whose corners are among the points
[[nodiscard]] std::string describe_float_steps(
    std::span<const Vec3> points, std::span<const std::span<const Face>> parts);

}  // namespace quasimc

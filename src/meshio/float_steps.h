#pragma once

#include <span>
#include <string>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

/// Describes coordinates that are rounded to single precision too coarsely for the triangles: their
/// step exceeds a hundredth of the median triangle's height. "" otherwise. The numbers are
/// examined, not the format, as those of a text may have been rounded before.
/// @param parts  faces, whose corners are among the points
[[nodiscard]] std::string describe_float_steps(
    std::span<const Vec3> points, std::span<const std::span<const Face>> parts);

}  // namespace quasimc

#pragma once

#include <numbers>

namespace quasimc {

/// Radians of a degree.
inline constexpr double kRadians = std::numbers::pi / 180;

}  // namespace quasimc

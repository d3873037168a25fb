#pragma once

#include <numbers>

namespace quasimc {

/// Radians of a degree.
inline constexpr double kRadians = std::numbers::pi / 180;

/// Radians of a full turn.
inline constexpr double kFullTurn = 2 * std::numbers::pi;

}  // namespace quasimc

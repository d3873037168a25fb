#pragma once

#include <numbers>

namespace quasimc {

inline constexpr double kPi = std::numbers::pi;

/// Radians per degree.
inline constexpr double kRadians = kPi / 180;

/// Radians of a full turn.
inline constexpr double kFullTurn = 2 * kPi;

}  // namespace quasimc

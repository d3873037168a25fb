#pragma once

#include <array>
#include <cmath>

namespace quasimc {

/// Point `i` of an additive recurrence in four dimensions, with the root of x^5 = x + 1 (Roberts
/// 2018): a fixed point set for pilot samples. Coordinates lie in [0, 1).
[[nodiscard]] inline std::array<double, 4> additive_recurrence_point(int i) {
    constexpr double kRoot = 1.1673039782614187;
    std::array<double, 4> u{};
    double step = 1;
    for (double& x : u) {
        step /= kRoot;
        const double turns = 0.5 + step * (i + 1);
        x = turns - std::floor(turns);
    }
    return u;
}

/// The steps of an additive recurrence in two dimensions, with the root of x^3 = x + 1 (Roberts
/// 2018): fractions of a turn.
inline constexpr std::array kPlaneSteps{0.7548776662466927, 0.5698402909980532};

}  // namespace quasimc

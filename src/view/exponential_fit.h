#pragma once

#include <optional>
#include <span>

namespace quasimc {

/// The curve amount * exp(-rate * x).
struct ExponentialCurve {
    double amount = 0, rate = 0;
    [[nodiscard]] double at(double x) const;
};

/// The curve with the least squared deviations from points: the method of Gauss and Newton, with
/// shorter steps where a whole one leads away. Nothing if there is no such curve to be found: fewer
/// than three places, or values that are not finite.
[[nodiscard]] std::optional<ExponentialCurve> fit_exponential(
    std::span<const double> x, std::span<const double> y);

}  // namespace quasimc

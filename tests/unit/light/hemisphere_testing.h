#pragma once

#include <functional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "base/vec3.h"

// Yardsticks for skies that share nothing with the code they measure.

namespace quasimc::test {

/// Borders in azimuth (0 to 2 pi) and sine of elevation (0 to 1) of a mesh that is finer by halves
/// towards given positions, where a function may have an edge or a cusp.
struct GradedMesh {
    std::vector<double> azimuths, sines;

    /// Towards all suns of support/skies.h, and with the given borders in it.
    explicit GradedMesh(
        std::span<const double> extra_azimuths = {}, std::span<const double> extra_sines = {});

    /// Integral of a function of the direction, by Gauss-Legendre quadrature with 5 x 5 points a
    /// cell.
    [[nodiscard]] double integral(const std::function<double(const Vec3&)>& f) const;
};

/// The direction of an azimuth and a sine of elevation.
[[nodiscard]] Vec3 upward(double azimuth, double sine);

/// A direction drawn with a weight.
struct WeightedDirection {
    Vec3 direction;
    double weight = 0;
};

/// Whether draws follow a density on the upper hemisphere: the sum of their weights in each of 8 x
/// 12 cells of equal solid angle is the integral of `density` there, by a chi-square of the sums
/// over their own errors.
[[nodiscard]] ::testing::AssertionResult follow(
    std::span<const WeightedDirection> draws,
    const std::function<double(const Vec3&)>& density,
    const GradedMesh& mesh,
    double level);

}  // namespace quasimc::test

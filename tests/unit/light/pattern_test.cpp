#include "light/models/pattern.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

using std::numbers::pi;

/// Integral over all directions of a function, on an even grid of cos theta and phi.
double over_sphere(const std::function<double(const Vec3&)>& f) {
    constexpr int kRows = 4000;
    constexpr int kColumns = 500;
    double sum = 0;
    for (int i = 0; i < kRows; ++i) {
        const double z = -1 + 2 * (i + .5) / kRows;
        const double radius = std::sqrt(1 - z * z);
        for (int j = 0; j < kColumns; ++j) {
            const double phi = 2 * pi * (j + .5) / kColumns;
            sum += f({radius * std::cos(phi), radius * std::sin(phi), z});
        }
    }
    return sum * 4 * pi / (kRows * kColumns);
}

/// Mean over the unit square, an additive recurrence, of weight times a function of the direction
/// drawn.
double over_draws(const Pattern& pattern, const std::function<double(const Vec3&)>& f) {
    constexpr int kPoints = 1 << 19;
    constexpr double kRoot = 1.324717957244746;  // x^3 = x + 1
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) {
        const auto part = [&](double step) { return .5 + step * i - std::floor(.5 + step * i); };
        const Pattern::Drawn drawn = pattern.draw(part(1 / kRoot), part(1 / (kRoot * kRoot)));
        EXPECT_NEAR(length(drawn.direction), 1, 1e-12);
        sum += drawn.weight * f(drawn.direction);
    }
    return sum / kPoints;
}

/// A pattern without any symmetry, two of whose sectors are dark.
Pattern uneven() {
    return {
        [](double theta, double phi) {
            return phi > 4 ? 0 : std::sin(theta) * (1.5 + std::cos(phi)) + .1;
        },
        refined({.2, 1, 2.5}, .05, 4), refined({0, 1, 4, 2 * pi}, .2, 2)};
}

class EveryPattern : public ::testing::TestWithParam<std::pair<std::string, Pattern>> {};

TEST_P(EveryPattern, SendsAFluxOfOne) {
    const Pattern& pattern = GetParam().second;
    const double flux = over_sphere([&](const Vec3& d) { return pattern.intensity(d); });
    EXPECT_NEAR(flux, 1, 2e-3);
    EXPECT_NEAR(over_draws(pattern, [](const Vec3&) { return 1; }), 1, 1e-4);
}

TEST_P(EveryPattern, DrawsTheIntensityItHas) {
    const Pattern& pattern = GetParam().second;
    const auto view = [](const Vec3& d) { return std::exp(d.x) + 2 * d.y * d.y + d.x * d.z; };
    const double looked_at =
        over_sphere([&](const Vec3& d) { return pattern.intensity(d) * view(d); });
    EXPECT_NEAR(over_draws(pattern, view), looked_at, 3e-3 * looked_at);
}

INSTANTIATE_TEST_SUITE_P(
    Patterns,
    EveryPattern,
    ::testing::Values(
        std::pair{"isotropic", isotropic_pattern()},
        std::pair{"cosine", cosine_pattern()},
        std::pair{"power", power_cosine_pattern(20)},
        std::pair{"half_power", power_cosine_pattern(.5)},
        std::pair{"hard_spot", spot_pattern(.4, .4)},
        std::pair{"soft_spot", spot_pattern(.1, .6)},
        std::pair{"soft_all_over", spot_pattern(0, pi)},
        std::pair{"tube", tube_pattern()},
        std::pair{"uneven", uneven()}),
    [](const auto& named) { return named.param.first; });

TEST(Pattern, HasTheClosedFormsOfItsKinds) {
    EXPECT_NEAR(isotropic_pattern().intensity({0, .6, -.8}), 1 / (4 * pi), 1e-12);
    EXPECT_NEAR(cosine_pattern().intensity({.6, 0, .8}), .8 / pi, 1e-9);
    EXPECT_EQ(cosine_pattern().intensity({.6, 0, -.8}), 0);
    EXPECT_NEAR(
        power_cosine_pattern(7).intensity({.6, 0, .8}), 8 / (2 * pi) * std::pow(.8, 7), 1e-6);
    EXPECT_NEAR(tube_pattern().intensity({.6, 0, .8}), .6 / (pi * pi), 1e-9);
    // A hard spot: its flux over the solid angle of its cone.
    const Pattern spot = spot_pattern(.3, .3);
    EXPECT_NEAR(spot.intensity({0, 0, 1}), 1 / (2 * pi * (1 - std::cos(.3))), 1e-9);
    EXPECT_EQ(spot.intensity({std::sin(.31), 0, std::cos(.31)}), 0);
}

/// A narrow beam must not be lost between the cells.
TEST(Pattern, KeepsTheLightOfABeamOfATenthOfADegree) {
    const double angle = .1 * pi / 180;
    const Pattern beam = spot_pattern(0, angle);
    for (const double u : {0.0, .3, .7, .999}) {
        const Pattern::Drawn drawn = beam.draw(u, .4);
        EXPECT_GE(drawn.direction.z, std::cos(angle) - 1e-15);
        EXPECT_LT(drawn.weight, 1.5);
    }
}

}  // namespace
}  // namespace quasimc::test

// The yardsticks of these tests, each against exact values.

#include "optics_testing.h"

#include <numbers>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

constexpr Vec3 kNormal{0.36, -0.48, 0.8};

TEST(OpticsYardsticks, ChiSquareTailsAreThoseOfTheTables) {
    EXPECT_NEAR(chi_square_tail(3.841458820694124, 1), 0.05, 1e-12);
    EXPECT_NEAR(chi_square_tail(4.605170185988092, 2), 0.1, 1e-12);
    EXPECT_NEAR(chi_square_tail(2.0, 2), std::exp(-1.0), 1e-14);
    EXPECT_NEAR(chi_square_tail(18.30703805327515, 10), 0.05, 1e-12);
    EXPECT_NEAR(chi_square_tail(149.4492528, 100), 0.001, 1e-9);
    EXPECT_NEAR(chi_square_tail(50, 2) / std::exp(-25.0), 1, 1e-12);
}

TEST(OpticsYardsticks, IntegralOverTheHemisphereIsExactForAPolynomial) {
    const auto cosine = [](const Vec3& d) { return dot(d, kNormal); };
    EXPECT_NEAR(integral(cosine, kNormal, {}, 1e-8), std::numbers::pi, 1e-12);
}

TEST(OpticsYardsticks, IntegralOverTheSphereFindsAStep) {
    const Vec3 axis = normalized({1, 2, -0.5});
    const auto half = [&](const Vec3& d) { return dot(d, axis) > 0 ? 1.0 : 0.0; };
    EXPECT_NEAR(sphere_integral(half, kNormal, 1e-4), 2 * std::numbers::pi, 1e-4);
}

TEST(OpticsYardsticks, IntegralOverTheHemisphereFindsANarrowPeak) {
    const Vec3 axis = direction_at(kNormal, 0.6, 0.3);
    const auto peak = [&](const Vec3& d) { return std::exp(1e4 * (dot(d, axis) - 1)); };
    EXPECT_NEAR(integral(peak, kNormal, {}, 1e-9), 2 * std::numbers::pi * 1e-4, 1e-9);
}

TEST(OpticsYardsticks, PointIsTheInverseOfDirection) {
    for (const double z : {0.01, 0.5, 0.99}) {
        for (const double t : {0.0, 0.3, 0.6, 0.99}) {
            const HemispherePoint at = point_of(kNormal, direction_at(kNormal, z, t));
            EXPECT_NEAR(at.z, z, 1e-12);
            EXPECT_NEAR(at.t, t, 1e-12);
        }
    }
}

TEST(OpticsYardsticks, RunningMeanOfFourNumbersIsExact) {
    RunningMean mean;
    for (const double x : {1.0, 2.0, 3.0, 4.0}) {
        mean.add(x);
    }
    EXPECT_DOUBLE_EQ(mean.measured().mean, 2.5);
    EXPECT_DOUBLE_EQ(mean.measured().standard_error, std::sqrt(5.0 / 12));
}

double uniform_pdf(const Vec3& /*d*/) {
    return 1 / (2 * std::numbers::pi);
}

TEST(OpticsYardsticks, ChiSquareTestPassesAUniformHemisphere) {
    const auto sample = [](double u0, double u1) { return direction_at(kNormal, u0, u1); };
    EXPECT_GT(chi_square_test(uniform_pdf, sample, kNormal, 20000), 1e-6);
}

TEST(OpticsYardsticks, ChiSquareTestFailsASlightlyDistortedOne) {
    const auto sample = [](double u0, double u1) {
        return direction_at(kNormal, std::pow(u0, 1.1), u1);
    };
    EXPECT_LT(chi_square_test(uniform_pdf, sample, kNormal, 20000), 1e-8);
}

}  // namespace
}  // namespace quasimc::test

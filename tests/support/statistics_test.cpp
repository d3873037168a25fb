#include "support/statistics.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Student's t at level 1e-6, both sides, 7 degrees of freedom (from tables of the distribution).
constexpr double kT7 = 15.767009437197181;

TEST(Agrees, AcceptsWhatLiesWithinTheInterval) {
    EXPECT_TRUE(agrees({1.0, 0.01, 8}, 1.0, 0.2));
    EXPECT_TRUE(agrees({1.0 + 0.999 * kT7 * 0.01, 0.01, 8}, 1.0, 0.2));
    EXPECT_TRUE(agrees({1.0 - 0.999 * kT7 * 0.01, 0.01, 8}, 1.0, 0.2));
}

TEST(Agrees, RefusesWhatLiesBeyondTheInterval) {
    EXPECT_FALSE(agrees({1.0 + 1.001 * kT7 * 0.01, 0.01, 8}, 1.0, 0.2));
    EXPECT_FALSE(agrees({1.0 - 1.001 * kT7 * 0.01, 0.01, 8}, 1.0, 0.2));
}

TEST(Agrees, RefusesAnErrorTooLargeToTell) {
    EXPECT_TRUE(agrees({1.0, 0.01, 8}, 1.0, 1.001 * kT7 * 0.01));
    EXPECT_FALSE(agrees({1.0, 0.01, 8}, 1.0, 0.999 * kT7 * 0.01));
    EXPECT_FALSE(agrees({5.0, 1e6, 8}, 1.0, 0.1));
}

TEST(Agrees, RefusesWhatIsNotANumber) {
    EXPECT_FALSE(agrees({kNan, 0.01, 8}, 1.0, 1.0));
    EXPECT_FALSE(agrees({1.0, kNan, 8}, 1.0, 1.0));
    EXPECT_FALSE(agrees({1.0, 0.01, 8}, kNan, 1.0));
    EXPECT_FALSE(agrees({1.0, 0.01, 8}, 1.0, kNan));
}

TEST(Agrees, RefusesASingleReplicate) {
    EXPECT_FALSE(agrees({1.0, 0.0, 1}, 1.0, 1.0));
    EXPECT_FALSE(agrees({1.0, 0.0, 1}, {1.0, 0.0, 8}, 1.0));
}

TEST(Agrees, ForgivesRoundingAndNoMoreWhereTheErrorIsZero) {
    EXPECT_TRUE(agrees({0.1 + 0.2, 0, 8}, 0.3, 1e-9));
    EXPECT_FALSE(agrees({0.3 + 1e-11, 0, 8}, 0.3, 1e-9));
}

TEST(Agrees, ComparesTwoMeasurementsByTheErrorOfTheirDifference) {
    const double half = kT7 * 0.05;
    EXPECT_TRUE(agrees({2.0, 0.03, 8}, {2.0 + 0.999 * half, 0.04, 8}, 1));
    EXPECT_FALSE(agrees({2.0, 0.03, 8}, {2.0 + 1.001 * half, 0.04, 8}, 1));
    EXPECT_FALSE(agrees({2.0, 0.03, 8}, {2.0, 0.04, 8}, 0.999 * half));
}

TEST(Agrees, TakesTheFewerDegreesOfFreedomOfTwo) {
    EXPECT_TRUE(agrees({2.0, 0.03, 8}, {2.0 + 0.999 * kT7 * 0.05, 0.04, 1000}, 1));
}

TEST(Agrees, FindsABiasThatTheResolutionPromisesToFind) {
    std::mt19937_64 bits(1);
    std::normal_distribution<double> noise(0, 1e-3);
    std::array<double, 16> values{};
    for (double& value : values) {
        value = 1 + noise(bits);
    }
    EXPECT_TRUE(agrees(measured(values), 1.0, 3e-3));
    EXPECT_FALSE(agrees(measured(values), 1.0 + 2 * 3e-3, 3e-3));
}

TEST(Agrees, FailsAsOftenAsItsLevelSays) {
    std::mt19937_64 bits(2);
    std::normal_distribution<double> noise(5, 2);
    const int tries = 20000;
    const double level = 0.05;
    int refused = 0;
    for (int i = 0; i < tries; ++i) {
        std::array<double, 8> values{};
        for (double& value : values) {
            value = noise(bits);
        }
        refused += agrees(measured(values), 5, 1e3, level) ? 0 : 1;
    }
    EXPECT_TRUE(agrees(measured_fraction(refused, tries, level), level, 0.01));
}

TEST(MeasuredFraction, HasTheBinomialError) {
    const Measured m = measured_fraction(30, 100, 0.2);
    EXPECT_DOUBLE_EQ(m.mean, 0.3);
    EXPECT_DOUBLE_EQ(m.standard_error, 0.04);
}

TEST(SidakLevel, LeavesTheFamilyAtItsLevel) {
    EXPECT_NEAR(sidak_level(0.05, 10), 0.005116196891823743, 1e-15);
    EXPECT_DOUBLE_EQ(sidak_level(1e-6, 1), 1e-6);
    EXPECT_NEAR(std::pow(1 - sidak_level(1e-3, 100), 100), 1 - 1e-3, 1e-12);
}

}  // namespace
}  // namespace quasimc::test

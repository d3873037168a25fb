// Directions of skies, replicate by replicate.

#include "transport/sky_directions.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "base/angles.h"
#include "light/models/hemisphere.h"
#include "support/statistics.h"

namespace quasimc::test {
namespace {

/// Numbers of points in a region of the hemisphere, for many replicates.
template <typename Inside>
std::vector<double> counts_of(std::uint32_t points, int replicates, const Inside& inside) {
    std::mt19937_64 bits(11);
    std::uniform_real_distribution<double> uniform;
    std::vector<double> counts;
    for (int r = 0; r < replicates; ++r) {
        const std::array<double, 3> placing{uniform(bits), uniform(bits), uniform(bits)};
        double count = 0;
        for (std::uint32_t i = 0; i < points; ++i) {
            const auto [u0, u1] = hemisphere_lattice(i, points, placing);
            count += inside(hemisphere_direction(kFullTurn * u1, u0)) ? 1 : 0;
        }
        counts.push_back(count);
    }
    return counts;
}

/// Mean, variance and skewness.
struct SampleStatistics {
    double mean = 0, variance = 0, skewness = 0;
};

SampleStatistics statistics_of(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    SampleStatistics m;
    for (const double x : values) {
        m.mean += x / n;
    }
    for (const double x : values) {
        m.variance += std::pow(x - m.mean, 2) / n;
        m.skewness += std::pow(x - m.mean, 3) / n;
    }
    m.skewness = m.variance > 0 ? m.skewness / std::pow(m.variance, 1.5) : 1e9;
    return m;
}

struct NamedCone {
    Vec3 axis;
    double half_angle_deg;
};

constexpr int kRotations = 600;

/// The variance of the number of lattice points in a cone depends on the points along its edge; a
/// number equal in nearly all replicates would have none, and an infinite skewness.
TEST(HemisphereLattice, FallsIntoAnyConeInVaryingNumbers) {
    for (const std::uint32_t points : {32U, 64U, 75U, 128U, 256U, 300U}) {
        for (const NamedCone& cone :
             {NamedCone{{0, 0, 1}, 25},
              {{0, 0, 1}, 40},
              {{0, 0, 1}, 60},
              {{.6, 0, .8}, 25},
              {{0, .8, .6}, 30}}) {
            const double least = std::cos(cone.half_angle_deg * kRadians);
            const std::vector<double> counts = counts_of(
                points, kRotations, [&](const Vec3& d) { return dot(d, cone.axis) > least; });
            const double expected = points * (1 - least);
            EXPECT_TRUE(agrees(measured(counts), expected, .05 * expected + .1, 1e-8));
            const SampleStatistics m = statistics_of(counts);
            EXPECT_GT(m.variance, .1 * std::sqrt(expected)) << points << " " << expected;
            EXPECT_LT(std::abs(m.skewness), 1) << points << " " << expected;
            // It remains a good lattice: far from random points.
            EXPECT_LT(m.variance, .7 * expected) << points << " " << expected;
        }
    }
}

TEST(HemisphereLattice, FallsIntoAnyBandOfHeightsInVaryingNumbers) {
    for (const std::uint32_t points : {64U, 128U, 256U}) {
        for (const double low : {0.0, .25, .5, .75}) {
            const std::vector<double> counts = counts_of(
                points, kRotations, [&](const Vec3& d) { return d.z > low && d.z <= low + .25; });
            const SampleStatistics m = statistics_of(counts);
            EXPECT_NEAR(m.mean, points / 4.0, 6 * std::sqrt(m.variance / kRotations) + 1e-9);
            EXPECT_GT(m.variance, .1 * std::sqrt(points / 4.0)) << points << " " << low;
            EXPECT_LT(std::abs(m.skewness), 1) << points << " " << low;
        }
    }
}

TEST(HemisphereLattice, IsUniformOverAllPlacements) {
    std::mt19937_64 bits(4);
    std::uniform_real_distribution<double> uniform;
    constexpr int kTries = 2000;
    std::vector<double> first, second, mixed;
    for (int n = 0; n < kTries; ++n) {
        const std::array<double, 3> placing{uniform(bits), uniform(bits), uniform(bits)};
        double a = 0, b = 0, c = 0;
        for (std::uint32_t i = 0; i < 16; ++i) {
            const auto [u0, u1] = hemisphere_lattice(i, 16, placing);
            a += u0 / 16;
            b += u0 * u0 / 16;
            c += u0 * u1 / 16;
        }
        first.push_back(a);
        second.push_back(b);
        mixed.push_back(c);
    }
    EXPECT_TRUE(agrees(measured(first), .5, .01));
    EXPECT_TRUE(agrees(measured(second), 1.0 / 3, .01));
    EXPECT_TRUE(agrees(measured(mixed), .25, .01));
}

}  // namespace
}  // namespace quasimc::test

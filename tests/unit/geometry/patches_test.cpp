#include "raster/patches.h"

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "geometry_testing.h"

namespace quasimc {
namespace {

/// A point on a triangle, uniform.
std::array<double, 2> random_uv(test::Random& random) {
    const double u = random.uniform();
    const double v = random.uniform();
    return u + v > 1 ? std::array{1 - u, 1 - v} : std::array{u, v};
}

TEST(Patches, AreEquallyLargePartsOfATriangle) {
    test::Random random(1);
    constexpr int kLevel = 3;
    constexpr int kEach = 1000;
    std::vector<int> counts(64);
    for (int i = 0; i < 64 * kEach; ++i) {
        const auto [u, v] = random_uv(random);
        ++counts.at(TriangleParts(kLevel).at(u, v));
    }
    double chi = 0;
    for (const int count : counts) {
        chi += std::pow(count - kEach, 2) / kEach;
    }
    // 63 degrees of freedom; the level is 1e-6.
    EXPECT_LT(chi, 130);
}

TEST(Patches, LieInThoseOfTheLevelAbove) {
    test::Random random(2);
    for (int level = 1; level <= Patches::kFinest; ++level) {
        for (int i = 0; i < 2000; ++i) {
            const auto [u, v] = random_uv(random);
            EXPECT_EQ(
                TriangleParts(level).parent(TriangleParts(level).at(u, v)),
                TriangleParts(level - 1).at(u, v))
                << level << " " << u << " " << v;
        }
    }
}

TEST(Patches, HaveFourInEachOfTheLevelAbove) {
    std::multiset<std::uint32_t> parents;
    for (std::uint32_t part = 0; part < 256; ++part) {
        parents.insert(TriangleParts(4).parent(part));
    }
    for (std::uint32_t parent = 0; parent < 64; ++parent) {
        EXPECT_EQ(parents.count(parent), 4U);
    }
}

TEST(Patches, AreNumberedFromTriangleToTriangle) {
    const Patches patches({1, Patches::kNone, 0, 2});
    EXPECT_EQ(patches.count(), 21U);
    EXPECT_FALSE(patches.has(1));
    EXPECT_EQ(patches.first(2), 4U);
    EXPECT_EQ(patches.first(3), 5U);
}

// Rounding may move a point on the border off it.
TEST(Patches, HoldPointsOnTheBorder) {
    for (const auto& [u, v] :
         {std::array{1., 0.}, {0., 1.}, {0., 0.}, {.5, .5}, {1 + 1e-9, -1e-9}}) {
        EXPECT_LT(TriangleParts(3).at(u, v), 64U);
    }
}

/// A line over a triangle: the segments are those that many points of it count.
TEST(Patches, CutALineWhereItPassesFromOneToTheNext) {
    test::Random random(3);
    constexpr int kPoints = 20000;
    std::vector<TriangleParts::Segment> scratch;
    for (int i = 0; i < 20; ++i) {
        const auto [au, av] = random_uv(random);
        const auto [bu, bv] = random_uv(random);
        const Barycentric a{static_cast<float>(au), static_cast<float>(av)};
        const Barycentric b{static_cast<float>(bu), static_cast<float>(bv)};
        std::vector<double> shares(64);
        double sum = 0;
        for (const auto& segment : TriangleParts(3).segments(a, b, scratch)) {
            shares.at(segment.part) += segment.share();
            sum += segment.share();
        }
        EXPECT_NEAR(sum, 1, 1e-12);
        for (int k = 0; k < kPoints; ++k) {
            const double f = (k + .5) / kPoints;
            shares[TriangleParts(3).at(a.u + f * (b.u - a.u), a.v + f * (b.v - a.v))] -=
                1. / kPoints;
        }
        for (const double share : shares) {
            EXPECT_NEAR(share, 0, 2. / kPoints);
        }
    }
}

}  // namespace
}  // namespace quasimc

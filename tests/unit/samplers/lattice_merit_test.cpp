#include "lattice_merit.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "samplers/hash.h"

namespace quasimc::test {
namespace {

/// The square of the length of the shortest dual vector with coordinates up to `reach`, by trying
/// all.
std::int64_t shortest_by_force(std::uint64_t n, std::span<const std::uint64_t> z, int reach) {
    std::vector<int> h(z.size(), -reach);
    std::int64_t best = INT64_MAX;
    while (true) {
        std::int64_t product = 0;
        std::int64_t length2 = 0;
        for (std::size_t i = 0; i < z.size(); ++i) {
            product += h[i] * static_cast<std::int64_t>(z[i]);
            length2 += h[i] * h[i];
        }
        if (length2 != 0 && product % static_cast<std::int64_t>(n) == 0)
            best = std::min(best, length2);
        std::size_t i = 0;
        while (i < h.size() && ++h[i] > reach)
            h[i++] = -reach;
        if (i == h.size())
            return best;
    }
}

TEST(LatticeMerit, FindsTheShortestVectorThatBruteForceFinds) {
    for (std::uint64_t i = 0; i < 60; ++i) {
        const std::uint64_t n = std::uint64_t{1} << (4 + i % 7);
        const std::size_t order = 2 + i % 4;
        std::vector<std::uint64_t> z{1};
        while (z.size() < order)
            z.push_back(mix64(100 * i + z.size()) % n);
        const double length = shortest_dual_vector(n, z);
        const auto best = shortest_by_force(n, z, static_cast<int>(std::ceil(length)));
        EXPECT_DOUBLE_EQ(length, std::sqrt(static_cast<double>(best))) << i;
    }
}

TEST(LatticeMerit, KnowsPlainLattices) {
    // All coordinates alike: the dual has (1, -1). One coordinate: the dual has n alone.
    EXPECT_DOUBLE_EQ(
        shortest_dual_vector(1024, std::array<std::uint64_t, 2>{1, 1}), std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(shortest_dual_vector(1024, std::array<std::uint64_t, 1>{1}), 1024);
    // The multiplier -1 mod n: the dual has (1, 1). Large n do not lose digits.
    const std::uint64_t n = std::uint64_t{1} << 40;
    EXPECT_DOUBLE_EQ(
        shortest_dual_vector(n, std::array<std::uint64_t, 2>{1, n - 1}), std::sqrt(2.0));
    // The position of the odd number does not matter.
    EXPECT_DOUBLE_EQ(
        shortest_dual_vector(64, std::array<std::uint64_t, 3>{2, 5, 7}),
        std::sqrt(
            static_cast<double>(shortest_by_force(64, std::array<std::uint64_t, 3>{2, 5, 7}, 8))));
}

TEST(LatticeMerit, IsOneForTheBestLatticeOfAll) {
    // Points i (1, 3) / 8 have the dual (2, 2), (3, -1), (1, -3): the shortest is 2 sqrt(2), of at
    // most sqrt(8 * 2 / sqrt(3)).
    EXPECT_NEAR(
        spectral_merit(8, std::array<std::uint64_t, 2>{1, 3}),
        std::sqrt(8.0) / std::sqrt(16 / std::sqrt(3.0)), 1e-4);
    EXPECT_NEAR(spectral_merit(2, std::array<std::uint64_t, 4>{1, 1, 1, 1}), 1, 1e-4);  // D4
}

TEST(LatticeMerit, SeesWhereThePowersRepeat) {
    // 5 has the period 16 mod 64, and two coordinates at lag 16 are the same.
    EXPECT_DOUBLE_EQ(
        korobov_pair_merit(64, 5, 16), spectral_merit(64, std::array<std::uint64_t, 2>{1, 1}));
    EXPECT_LE(korobov_dimensions(64, 5), 16U);
    EXPECT_EQ(korobov_dimensions(4, 5), 1U);
}

}  // namespace
}  // namespace quasimc::test

#include "samplers/korobov.h"

#include <array>
#include <cstdint>
#include <set>

#include <gtest/gtest.h>

#include "lattice_merit.h"
#include "sampler_testing.h"
#include "samplers/korobov_table.h"

namespace quasimc::test {
namespace {

struct Thresholds {
    double merit, two, four;
};

/// What an entry of the table must reach. Few points leave little choice.
Thresholds thresholds(int m) {
    return m < 6 ? Thresholds{0.45, 0.65, 0.7} : Thresholds{0.2, 0.5, 0.5};
}

/// Whether a multiplier is fit for the table.
::testing::AssertionResult fit(int m, std::uint64_t a, std::uint32_t dimensions) {
    const std::uint64_t n = std::uint64_t{1} << m;
    const Thresholds least = thresholds(m);
    const double merit = korobov_merit(n, a, dimensions);
    const double two = korobov_serial_merit(n, a, 2);
    const double four = korobov_serial_merit(n, a, 4);
    const std::uint32_t good = korobov_dimensions(n, a);
    if (merit < least.merit || two < least.two || four < least.four || good < dimensions)
        return ::testing::AssertionFailure()
               << "2^" << m << " points, multiplier " << a << ": merits " << merit << ", " << two
               << ", " << four << ", " << good << " good dimensions";
    return ::testing::AssertionSuccess();
}

TEST(Korobov, HasAGoodLatticeForEveryPowerOfTwo) {
    for (int m = 0; m <= kMaxKorobovLog2; ++m) {
        const auto [multiplier, dimensions] = kKorobovLattices[m];
        EXPECT_TRUE(fit(m, multiplier, dimensions));
        EXPECT_EQ(multiplier % 8, 5U) << "the powers have not their longest period";
        EXPECT_EQ(dimensions, korobov_dimensions(std::uint64_t{1} << m, multiplier));
        EXPECT_GE(dimensions, m < 6 ? 1U : m < 11 ? 16U : m < 16 ? 32U : 64U);
    }
}

TEST(Korobov, RefusesADegenerateLattice) {
    for (const int m : {7, 14, 16, 30}) {
        EXPECT_FALSE(fit(m, 1, 16)) << "all coordinates the same";
        EXPECT_FALSE(fit(m, (std::uint64_t{1} << (m - 1)) + 1, 16)) << "two lines";
        EXPECT_FALSE(fit(m, 5, 16)) << "five lines";
    }
}

TEST(Korobov, HasAllCoordinatesOfTheLatticeStratified) {
    const auto sampler = make_korobov();
    for (int m = 0; m <= 13; ++m) {
        const std::uint64_t n = std::uint64_t{1} << m;
        for (std::uint32_t j = 0; j < kKorobovLattices[m].dimensions; ++j) {
            const Stream stream{.seed = 2, .replicate = j, .first = 3 * n, .count = n};
            ASSERT_TRUE(all_one(counts(coordinates(*sampler, stream, j), n)))
                << "2^" << m << " points, dimension " << j;
        }
    }
}

TEST(Korobov, IsTheShiftedLatticeToTheLastBit) {
    const auto sampler = make_korobov();
    const int m = 16;
    const std::uint64_t n = std::uint64_t{1} << m;
    const Stream stream{.seed = 2, .replicate = 4, .first = 5 * n, .count = n};
    const auto bits = [](double x) { return static_cast<std::uint64_t>(x * 0x1p53); };
    std::uint64_t power = 1;
    for (std::uint32_t j = 0; j < 8; ++j) {
        const std::uint64_t shift = bits(sampler->coordinate(stream, stream.first, j));
        for (std::uint64_t i = 0; i < n; i += 37) {
            const std::uint64_t sum = shift + ((i * power % n) << (53 - m));
            ASSERT_EQ(bits(sampler->coordinate(stream, stream.first + i, j)), sum % (1ULL << 53));
        }
        power = power * kKorobovLattices[m].multiplier % n;
    }
}

TEST(Korobov, ShiftsEveryRoundAndDimensionAnew) {
    const auto sampler = make_korobov();
    std::set<double> shifts;
    for (std::uint64_t round = 0; round < 20; ++round)
        for (std::uint32_t dimension = 0; dimension < 16; ++dimension)
            for (std::uint32_t replicate = 0; replicate < 4; ++replicate) {
                const Stream stream{.replicate = replicate, .first = round * 1024, .count = 1024};
                shifts.insert(sampler->coordinate(stream, stream.first, dimension));
            }
    EXPECT_EQ(shifts.size(), 20U * 16 * 4);
}

TEST(Korobov, DrawsRandomNumbersWhereItsDimensionsEnd) {
    const auto sampler = make_korobov();
    const Stream stream{.count = 16};
    const std::uint32_t first_random = kKorobovLattices[4].dimensions;
    EXPECT_TRUE(all_one(counts(coordinates(*sampler, stream, first_random - 1), 16)));
    EXPECT_FALSE(all_one(counts(coordinates(*sampler, stream, first_random), 16)));
}

TEST(Korobov, TakesRoundsOfAnyPowerOfTwo) {
    const auto sampler = make_korobov();
    EXPECT_TRUE(sampler->needs_power_of_two());
    for (int m = 0; m <= 50; ++m) {
        const std::uint64_t n = std::uint64_t{1} << m;
        const Stream stream{.first = n, .count = n};
        EXPECT_NE(sampler->coordinate(stream, n, 0), sampler->coordinate(stream, n + n / 2, 1));
        EXPECT_LT(sampler->coordinate(stream, 2 * n - 1, 0), 1);
    }
}

#ifndef NDEBUG
TEST(KorobovDeathTest, EndsAtARoundThatIsNoPowerOfTwo) {
    EXPECT_DEATH(
        static_cast<void>(make_korobov()->coordinate({.count = 1000}, 0, 0)), "has_single_bit");
}
#endif

}  // namespace
}  // namespace quasimc::test

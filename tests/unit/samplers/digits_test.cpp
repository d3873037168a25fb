// Halton's and Faure's sequences, and the scramble of digits that they share.

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "sampler_testing.h"
#include "samplers/digit_scramble.h"
#include "samplers/faure.h"
#include "samplers/halton.h"
#include "samplers/hash.h"
#include "support/statistics.h"

namespace quasimc::test {
namespace {

/// The digits of a number in [0, 1), first digit first.
std::vector<std::uint32_t> digits(double x, std::uint32_t base, int count) {
    std::vector<std::uint32_t> result;
    for (int i = 0; i < count; ++i) {
        x *= base;
        result.push_back(static_cast<std::uint32_t>(x));
        x -= result.back();
    }
    return result;
}

class DigitScrambleInBase : public ::testing::TestWithParam<std::uint32_t> {};

INSTANTIATE_TEST_SUITE_P(Primes, DigitScrambleInBase, ::testing::Values(2, 3, 5, 7, 11, 23, 311));

TEST_P(DigitScrambleInBase, HasALongPeriod) {
    const DigitScramble scramble(GetParam());
    std::uint64_t power = 1;
    for (int i = 0; i < scramble.digits(); ++i)
        power *= GetParam();
    EXPECT_EQ(power, scramble.period());
    EXPECT_GT(scramble.period(), 1U << 24);
}

TEST_P(DigitScrambleInBase, KeepsPrefixes) {
    const std::uint32_t base = GetParam();
    const DigitScramble scramble(base);
    std::uint32_t difference = 1;
    for (int common = 0; common < 3; ++common) {
        for (std::uint64_t i = 0; i < 200; ++i) {
            const auto key = scramble.key(mix64(i));
            const auto a = static_cast<std::uint32_t>(mix64(i + 1000) % scramble.period());
            const std::uint32_t b = (a + difference) % scramble.period();
            const auto x = digits(scramble.coordinate(a, key), base, common + 1);
            const auto y = digits(scramble.coordinate(b, key), base, common + 1);
            for (int k = 0; k < common; ++k)
                ASSERT_EQ(x[k], y[k]);
            ASSERT_NE(x[common], y[common]);
        }
        difference *= base;
    }
}

class DigitScrambleInSmallBase : public ::testing::TestWithParam<std::uint32_t> {};

INSTANTIATE_TEST_SUITE_P(Primes, DigitScrambleInSmallBase, ::testing::Values(2, 3, 5, 7));

TEST_P(DigitScrambleInSmallBase, TreatsPairsAsOwensDoes) {
    // Two numbers that agree in their first digit: in both scrambled values it is uniform; the
    // second digits are any two different ones, equally often; so are the third ones, any two.
    const std::uint32_t base = GetParam();
    constexpr std::uint64_t kKeys = 1 << 15;
    const DigitScramble scramble(base);
    const std::uint32_t a = 123457;
    const std::uint32_t b = a + base * (base + 1);
    std::vector<std::uint64_t> first(base);
    std::vector<std::uint64_t> second(base * (base - 1));
    std::vector<std::uint64_t> third(base * base);
    for (std::uint64_t i = 0; i < kKeys; ++i) {
        const auto key = scramble.key(mix64(i));
        const auto x = digits(scramble.coordinate(a, key), base, 3);
        const auto y = digits(scramble.coordinate(b, key), base, 3);
        ASSERT_EQ(x[0], y[0]);
        ++first[x[0]];
        ++second[x[1] * (base - 1) + (y[1] + base - x[1]) % base - 1];
        ++third[x[2] * base + y[2]];
    }
    EXPECT_TRUE(equally_likely(first, kLevel / 3));
    EXPECT_TRUE(equally_likely(second, kLevel / 3));
    EXPECT_TRUE(equally_likely(third, kLevel / 3));
}

TEST(Halton, UsesThePrimesInOrder) {
    EXPECT_EQ(halton_base(0), 2U);
    EXPECT_EQ(halton_base(1), 3U);
    EXPECT_EQ(halton_base(9), 29U);
    EXPECT_EQ(halton_base(kHaltonDimensions - 1), 311U);
}

TEST(Halton, HasOnePointInEveryInterval) {
    const auto sampler = make_halton();
    for (std::uint32_t j = 0; j < kHaltonDimensions; ++j)
        for (std::uint64_t n = halton_base(j); n < 20000; n *= halton_base(j)) {
            const Stream stream{.seed = j, .first = 2 * n, .count = n};
            ASSERT_TRUE(all_one(counts(coordinates(*sampler, stream, j), n)))
                << n << " points, dimension " << j;
        }
}

TEST(Halton, HasOnePointInEveryElementaryBox) {
    const auto sampler = make_halton();
    struct Box {
        std::uint32_t j, k;
        std::uint64_t columns, rows;
    };
    for (const auto& [j, k, columns, rows] :
         {Box{0, 1, 32, 27}, Box{0, 1, 4, 729}, Box{1, 2, 27, 25}, Box{0, 3, 64, 49},
          Box{4, 5, 11, 13}}) {
        const Stream stream{.seed = 3, .first = 5 * columns * rows, .count = columns * rows};
        const auto x = coordinates(*sampler, stream, j);
        const auto y = coordinates(*sampler, stream, k);
        EXPECT_TRUE(all_one(counts(x, y, columns, rows)));
        EXPECT_FALSE(all_one(counts(y, x, columns, rows))) << "the negative control";
    }
}

TEST(Faure, HasOnePointInEveryInterval) {
    const auto sampler = make_faure();
    for (std::uint32_t j = 0; j < 4 * kFaureDimensions; ++j)
        for (std::uint64_t n = 1; n < 20000; n *= kFaureBase) {
            const Stream stream{.seed = j, .first = 3 * n, .count = n};
            ASSERT_TRUE(all_one(counts(coordinates(*sampler, stream, j), n)))
                << n << " points, dimension " << j;
        }
}

TEST(Faure, HasOnePointInEveryElementaryBoxOfAnyTwoDimensionsOfABlock) {
    const auto sampler = make_faure();
    constexpr std::uint64_t kPoints = 1331;
    for (const std::uint64_t round : {0, 4, 60})
        for (const std::uint32_t block : {0U, 1U, 3U})
            for (std::uint32_t j = 0; j < kFaureDimensions; ++j)
                for (std::uint32_t k = 0; k < j; ++k) {
                    const Stream stream{.first = round * kPoints, .count = kPoints};
                    const auto x = coordinates(*sampler, stream, kFaureDimensions * block + j);
                    const auto y = coordinates(*sampler, stream, kFaureDimensions * block + k);
                    for (const std::uint64_t columns : {11U, 121U})
                        EXPECT_TRUE(all_one(counts(x, y, columns, kPoints / columns)));
                }
}

TEST(Faure, BlocksOfDimensionsAreNoJointNet) {
    // The negative control of the elementary boxes.
    const auto sampler = make_faure();
    const auto x = coordinates(*sampler, {.count = 14641}, 0);
    const auto y = coordinates(*sampler, {.count = 14641}, kFaureDimensions);
    EXPECT_FALSE(all_one(counts(x, y, 121, 121)));
}

TEST(Faure, HasOnePointInEveryElementaryBoxOfFourDimensions) {
    const auto sampler = make_faure();
    const Stream stream{.seed = 9, .count = 14641};
    std::vector<std::uint64_t> box(stream.count);
    for (std::uint64_t i = 0; i < stream.count; ++i) {
        std::size_t at = 0;
        for (const std::uint32_t j : {0U, 2U, 3U, 9U})
            at = at * 11 + static_cast<std::size_t>(sampler->coordinate(stream, i, j) * 11);
        ++box[at];
    }
    EXPECT_TRUE(all_one(box));
}

}  // namespace
}  // namespace quasimc::test

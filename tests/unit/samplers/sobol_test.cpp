#include "samplers/sobol.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "sampler_testing.h"
#include "samplers/hash.h"
#include "support/statistics.h"

namespace quasimc::test {
namespace {

TEST(Sobol, StartsAsInTheTablesOfJoeAndKuo) {
    // The output of their program sobol.cc for the file new-joe-kuo-6.21201 in eighths: points
    // 0 ... 7, in the order of Gray's code, of ten dimensions.
    constexpr std::array<std::array<std::uint32_t, 10>, 8> kEighths{{
        {0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
        {4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
        {6, 2, 2, 2, 6, 6, 2, 6, 6, 6},
        {2, 6, 6, 6, 2, 2, 6, 2, 2, 2},
        {3, 3, 5, 7, 3, 1, 3, 7, 7, 5},
        {7, 7, 1, 3, 7, 5, 7, 3, 3, 1},
        {5, 1, 7, 5, 5, 7, 1, 1, 1, 3},
        {1, 5, 3, 1, 1, 3, 5, 5, 5, 7},
    }};
    for (std::uint32_t i = 0; i < kEighths.size(); ++i)
        for (std::uint32_t j = 0; j < kEighths[i].size(); ++j)
            EXPECT_EQ(reverse_bits(sobol_digits(i ^ (i >> 1), j)) >> 29, kEighths[i][j])
                << "point " << i << ", dimension " << j;
}

TEST(Sobol, IsLinearInTheBitsOfTheIndex) {
    for (std::uint32_t j = 0; j < kSobolDimensions; ++j)
        for (std::uint64_t i = 0; i < 200; ++i) {
            const auto a = static_cast<std::uint32_t>(mix64(i));
            const auto b = static_cast<std::uint32_t>(mix64(i) >> 32);
            ASSERT_EQ(sobol_digits(a ^ b, j), sobol_digits(a, j) ^ sobol_digits(b, j));
        }
}

TEST(Sobol, HasOnePointInEveryInterval) {
    const auto sampler = make_sobol();
    for (std::uint32_t j = 0; j < 3 * kSobolDimensions; ++j)
        for (const std::uint64_t n : {1U, 2U, 16U, 512U, 4096U})
            for (const std::uint64_t round : {0U, 1U, 5U}) {
                const Stream stream{.seed = j, .replicate = 1, .first = round * n, .count = n};
                ASSERT_TRUE(all_one(counts(coordinates(*sampler, stream, j), n)))
                    << n << " points, dimension " << j;
            }
}

/// Whether every dyadic box of area 1 / n holds one of the n points.
bool is_net(const Sampler& sampler, const Stream& stream, std::uint32_t j, std::uint32_t k) {
    const auto x = coordinates(sampler, stream, j);
    const auto y = coordinates(sampler, stream, k);
    for (std::uint64_t columns = 1; columns <= stream.count; columns *= 2)
        if (!all_one(counts(x, y, columns, stream.count / columns)))
            return false;
    return true;
}

TEST(Sobol, HasOnePointInEveryElementaryBoxOfTheFirstTwoDimensions) {
    const auto sampler = make_sobol();
    for (const std::uint64_t n : {2U, 64U, 1024U, 16384U})
        for (std::uint32_t replicate = 0; replicate < 4; ++replicate)
            for (const std::uint64_t round : {0U, 1U, 6U}) {
                const Stream stream{
                    .seed = 7, .replicate = replicate, .first = round * n, .count = n};
                EXPECT_TRUE(is_net(*sampler, stream, 0, 1)) << n;
                EXPECT_TRUE(is_net(*sampler, stream, kSobolDimensions, kSobolDimensions + 1)) << n;
            }
}

TEST(Sobol, ElementaryBoxesTellPairsThatAreNoNet) {
    // The negative control: dimensions 0 and 1 of different blocks, or points that are not aligned.
    const auto sampler = make_sobol();
    EXPECT_FALSE(is_net(*sampler, {.count = 1024}, 0, kSobolDimensions + 1));
    EXPECT_FALSE(is_net(*sampler, {.first = 100, .count = 1024}, 0, 1));
}

TEST(Sobol, ScrambleKeepsPrefixes) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const auto a = static_cast<std::uint32_t>(mix64(i));
        const std::uint32_t b = a ^ (static_cast<std::uint32_t>(mix64(i) >> 32) << (i % 32));
        const std::uint64_t key = mix64(i + 5000);
        EXPECT_EQ(
            std::countr_zero(a ^ b),
            std::countr_zero(owen_scramble(a, key) ^ owen_scramble(b, key)));
    }
}

TEST(Sobol, ScrambleTreatsPairsAsOwensDoes) {
    // For two numbers that first differ in digit r: both scrambled values, up to digit r + 3, hit
    // all possible combinations with equal frequency over the keys.
    constexpr int kKeys = 1 << 15;
    for (int r = 0; r < 6; ++r) {
        const std::uint32_t a = 0x2c9277b5U;
        const std::uint32_t b = a ^ (0x9d2c5681U << r);
        std::vector<std::uint64_t> cells(std::size_t{1} << (r + 3 + 2));
        for (std::uint64_t i = 0; i < kKeys; ++i) {
            const std::uint64_t key = mix64(i ^ (std::uint64_t{77} << 40));
            const std::uint32_t x = owen_scramble(a, key);
            const std::uint32_t y = owen_scramble(b, key);
            const std::uint32_t first = x & ((1U << (r + 3)) - 1);  // digits 0 ... r + 2 of x
            const std::uint32_t later = (x ^ y) >> (r + 1) & 3U;    // digits r + 1, r + 2 of y
            ++cells[first << 2 | later];
        }
        EXPECT_TRUE(equally_likely(cells, kLevel / 6)) << r;
    }
}

TEST(Sobol, TakesPointsBeyond32Bits) {
    const auto sampler = make_sobol();
    const std::uint64_t period = std::uint64_t{1} << 32;
    const Stream stream{.first = 3 * period, .count = 1024};
    EXPECT_TRUE(is_net(*sampler, stream, 0, 1));
    EXPECT_NE(sampler->coordinate(stream, period, 0), sampler->coordinate(stream, 0, 0));
}

}  // namespace
}  // namespace quasimc::test

#include "samplers/vector_loops.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "support/vector_units.h"

namespace quasimc {
namespace {

constexpr std::uint64_t kKey = 0x9e3779b97f4a7c15U;

TEST(VectorLoops, ScrambleTheSameBitsOnEveryVectorUnit) {
    std::array<std::uint32_t, kSobolBlock> lowest{};
    std::array<double, kSobolBlock> expected{};
    const std::uint32_t base = 0x12345670U;
    for (std::uint32_t i = 0; i < kSobolBlock; ++i) {
        lowest[i] = i * 0x85ebca6bU;
        const std::uint32_t first = reverse_bits(scrambled(base ^ lowest[i], ScrambleKey(kKey)));
        const std::uint32_t more = more_bits(first, ScrambleKey(kKey));
        expected[i] = unit_number(std::uint64_t{first} << 32 | more);
    }
    for_each_vector_unit([&] {
        std::array<double, kSobolBlock> numbers{};
        best_vector_loops().scramble_block(base, lowest.data(), ScrambleKey(kKey), numbers.data());
        EXPECT_EQ(numbers, expected);
    });
}

TEST(VectorLoops, FillTheSameLatticeOnEveryVectorUnit) {
    for (const std::size_t count : {0U, 1U, 7U, 8U, 33U}) {
        std::vector<double> expected;
        for (std::size_t i = 0; i < count; ++i) {
            expected.push_back(unit_number(kKey + i * (kKey | 3U)));
        }
        for_each_vector_unit([&] {
            std::vector<double> numbers(count);
            best_vector_loops().fill_lattice(kKey, kKey | 3U, numbers.data(), count);
            EXPECT_EQ(numbers, expected) << count;
        });
    }
}

}  // namespace
}  // namespace quasimc

#include "quasimc/share.h"

#include <limits>

#include <gtest/gtest.h>

namespace quasimc {
namespace {

using Range = std::pair<std::uint64_t, std::uint64_t>;

TEST(Share, CutsTasksWhereProportionSays) {
    EXPECT_EQ(share_of(1, 3).range(10), Range(0, 3));
    EXPECT_EQ(share_of(2, 3).range(10), Range(3, 6));
    EXPECT_EQ(share_of(3, 3).range(10), Range(6, 10));
    for (std::uint64_t of = 1; of < 40; ++of) {
        for (std::uint64_t tasks = 0; tasks < 100; ++tasks) {
            for (std::uint64_t part = 1; part <= of; ++part) {
                const Range expected{(part - 1) * tasks / of, part * tasks / of};
                ASSERT_EQ(share_of(part, of).range(tasks), expected);
            }
        }
    }
}

TEST(Share, IsExactWhereProductsOutgrowTheirType) {
    constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
    EXPECT_EQ(share_of(kLargest, kLargest).range(kLargest), Range(kLargest - 1, kLargest));
    EXPECT_EQ((Share{1, 2, 2}.range(kLargest)), Range(kLargest / 2, kLargest));
    // (2^64 - 1) * (2^63 + 1) / (2^64 - 3) = 2^63 + 2 + 6 / (2^64 - 3)
    const std::uint64_t half = std::uint64_t{1} << 63U;
    EXPECT_EQ((Share{0, half + 1, kLargest - 2}.range(kLargest)), Range(0, half + 2));
    // 2^40 * (3 * 2^38) / 2^40
    const std::uint64_t large = std::uint64_t{1} << 40U;
    EXPECT_EQ((Share{0, 3 * large / 4, large}.range(large)), Range(0, 3 * large / 4));
}

}  // namespace
}  // namespace quasimc

#include "transport/start_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

/// Some n random starts.
PathStarts random_starts(std::size_t n) {
    PathStarts starts;
    std::mt19937_64 bits(1);
    std::uniform_real_distribution<double> uniform;
    for (std::size_t i = 0; i < n; ++i) {
        starts.u0.push_back(uniform(bits));
        starts.u1.push_back(uniform(bits));
    }
    return starts;
}

/// Mean distance from each start to the next.
double mean_step(const PathStarts& starts) {
    double sum = 0;
    for (std::size_t i = 1; i < starts.order.size(); ++i) {
        const std::uint32_t a = starts.order[i - 1];
        const std::uint32_t b = starts.order[i];
        sum += std::hypot(starts.u0[a] - starts.u0[b], starts.u1[a] - starts.u1[b]);
    }
    return sum / static_cast<double>(starts.order.size() - 1);
}

TEST(StartOrder, HoldsEveryStartOnce) {
    for (const std::size_t n : {1U, 2U, 15U, 1000U, 16384U}) {
        PathStarts starts = random_starts(n);
        order_starts({}, 1, starts);
        std::vector<std::uint32_t> sorted = starts.order;
        std::sort(sorted.begin(), sorted.end());
        std::vector<std::uint32_t> all(n);
        std::iota(all.begin(), all.end(), 0U);
        EXPECT_EQ(sorted, all) << n;
    }
}

TEST(StartOrder, PutsNeighboursNextToEachOther) {
    constexpr std::size_t kStarts = 16384;
    PathStarts starts = random_starts(kStarts);
    starts.order.resize(kStarts);
    std::iota(starts.order.begin(), starts.order.end(), 0U);
    EXPECT_GT(mean_step(starts), .5) << "a random order is no good";
    order_starts({}, 1, starts);
    EXPECT_LT(mean_step(starts), 3 / std::sqrt(kStarts));
}

TEST(StartOrder, KeepsTheOrderOfStartsAtOnePoint) {
    PathStarts starts;
    starts.u0.assign(1000, .3);
    starts.u1.assign(1000, .7);
    order_starts({}, 1, starts);
    EXPECT_TRUE(std::is_sorted(starts.order.begin(), starts.order.end()));
}

TEST(StartOrder, KeepsTheStartsOfALightTogether) {
    PathStarts starts = random_starts(3000);
    std::vector<std::uint32_t> groups;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        groups.push_back(i * i % 7);
    }
    order_starts(groups, 7, starts);
    EXPECT_TRUE(std::is_sorted(
        starts.order.begin(), starts.order.end(),
        [&](std::uint32_t a, std::uint32_t b) { return groups[a] < groups[b]; }));
}

TEST(StartOrder, IsTheSameWhateverWasOrderedBefore) {
    PathStarts fresh = random_starts(500);
    order_starts({}, 1, fresh);
    PathStarts used = random_starts(9000);
    order_starts(std::vector<std::uint32_t>(9000, 2), 5, used);
    used.u0 = fresh.u0;
    used.u1 = fresh.u1;
    order_starts({}, 1, used);
    EXPECT_EQ(used.order, fresh.order);
}

TEST(StartOrder, TakesTheBordersOfTheSquare) {
    PathStarts starts;
    starts.u0 = {0, 0x1.fffffffffffffp-1, 0, 0x1.fffffffffffffp-1};
    starts.u1 = {0x1.fffffffffffffp-1, 0x1.fffffffffffffp-1, 0, 0};
    order_starts({}, 1, starts);
    EXPECT_EQ(starts.order.size(), 4U);
}

}  // namespace
}  // namespace quasimc::test

#include "transport/start_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

/// A workspace with n random starts.
Workspace random_starts(std::size_t n) {
    Workspace workspace(1);
    std::mt19937_64 bits(1);
    std::uniform_real_distribution<double> uniform;
    for (std::size_t i = 0; i < n; ++i) {
        workspace.u0.push_back(uniform(bits));
        workspace.u1.push_back(uniform(bits));
    }
    return workspace;
}

/// How far it is from each start to the next, on average.
double mean_step(const Workspace& workspace) {
    double sum = 0;
    for (std::size_t i = 1; i < workspace.order.size(); ++i) {
        const std::uint32_t a = workspace.order[i - 1];
        const std::uint32_t b = workspace.order[i];
        sum += std::hypot(workspace.u0[a] - workspace.u0[b], workspace.u1[a] - workspace.u1[b]);
    }
    return sum / static_cast<double>(workspace.order.size() - 1);
}

TEST(StartOrder, HoldsEveryStartOnce) {
    for (const std::size_t n : {1U, 2U, 15U, 1000U, 16384U}) {
        Workspace workspace = random_starts(n);
        order_starts({}, 1, workspace);
        std::vector<std::uint32_t> sorted = workspace.order;
        std::sort(sorted.begin(), sorted.end());
        std::vector<std::uint32_t> all(n);
        std::iota(all.begin(), all.end(), 0U);
        EXPECT_EQ(sorted, all) << n;
    }
}

TEST(StartOrder, PutsNeighboursNextToEachOther) {
    constexpr std::size_t kStarts = 16384;
    Workspace workspace = random_starts(kStarts);
    workspace.order.resize(kStarts);
    std::iota(workspace.order.begin(), workspace.order.end(), 0U);
    EXPECT_GT(mean_step(workspace), .5) << "a random order is no good";
    order_starts({}, 1, workspace);
    EXPECT_LT(mean_step(workspace), 3 / std::sqrt(kStarts));
}

TEST(StartOrder, KeepsTheOrderOfStartsAtOnePlace) {
    Workspace workspace(1);
    workspace.u0.assign(1000, .3);
    workspace.u1.assign(1000, .7);
    order_starts({}, 1, workspace);
    EXPECT_TRUE(std::is_sorted(workspace.order.begin(), workspace.order.end()));
}

TEST(StartOrder, KeepsTheStartsOfALightTogether) {
    Workspace workspace = random_starts(3000);
    std::vector<std::uint32_t> groups;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        groups.push_back(i * i % 7);
    }
    order_starts(groups, 7, workspace);
    EXPECT_TRUE(std::is_sorted(
        workspace.order.begin(), workspace.order.end(),
        [&](std::uint32_t a, std::uint32_t b) { return groups[a] < groups[b]; }));
}

TEST(StartOrder, IsTheSameWhateverTheWorkspaceHeldBefore) {
    Workspace fresh = random_starts(500);
    order_starts({}, 1, fresh);
    Workspace used = random_starts(9000);
    order_starts(std::vector<std::uint32_t>(9000, 2), 5, used);
    used.u0 = fresh.u0;
    used.u1 = fresh.u1;
    order_starts({}, 1, used);
    EXPECT_EQ(used.order, fresh.order);
}

TEST(StartOrder, TakesTheBordersOfTheSquare) {
    Workspace workspace(1);
    workspace.u0 = {0, 0x1.fffffffffffffp-1, 0, 0x1.fffffffffffffp-1};
    workspace.u1 = {0x1.fffffffffffffp-1, 0x1.fffffffffffffp-1, 0, 0};
    order_starts({}, 1, workspace);
    EXPECT_EQ(workspace.order.size(), 4U);
}

}  // namespace
}  // namespace quasimc::test

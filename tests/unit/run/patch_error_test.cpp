#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "results/bounds/patch_error_pool.h"

namespace quasimc::test {
namespace {

struct Draw {
    double scattered, difference;
};

PatchErrorPool pool_of(const std::vector<Draw>& draws) {
    PatchErrorPool pool;
    for (const Draw& draw : draws) {
        pool.add(draw.scattered, draw.difference);
    }
    return pool;
}

/// A difference that is small by chance is replaced by that of organs with equal scattered light.
TEST(PatchErrorPool, GivesAnOrganHalfOfWhatOthersHave) {
    const PatchErrorPool pool = pool_of({{1, .3}, {1, -.3}, {2, .6}, {2, -.6}});
    EXPECT_NEAR(pool.shrunk(0, 1), .3 / std::sqrt(2), 1e-15);
    EXPECT_NEAR(pool.shrunk(0, 2), .6 / std::sqrt(2), 1e-15);
    EXPECT_NEAR(pool.shrunk(.3, 1), .3, 1e-15);
    EXPECT_NEAR(pool.shrunk(-.9, 1), std::sqrt((.81 + .09) / 2), 1e-15);
    EXPECT_EQ(pool.shrunk(0, 0), 0) << "no light that patches sent";
}

TEST(PatchErrorPool, KeepsTheSumOfSquares) {
    const std::vector<Draw> draws{{1, .3}, {3, -.2}, {.5, .4}, {2, .1}, {0, 0}};
    const PatchErrorPool pool = pool_of(draws);
    double before = 0, after = 0;
    for (const auto& [scattered, difference] : draws) {
        before += difference * difference;
        after += std::pow(pool.shrunk(difference, scattered), 2);
    }
    EXPECT_NEAR(after, before, 1e-14);
}

/// Common errors of organs add up in a group, individual ones average out.
TEST(PatchErrorPool, KeepsTheCommonErrorOfGroups) {
    const PatchErrorPool alike = pool_of({{1, .1}, {2, .2}, {3, .3}});
    EXPECT_NEAR(alike.shrunk(.6, 6, 14), .6, 1e-15);
    const PatchErrorPool apart = pool_of({{1, .1}, {1, -.1}, {1, .1}, {1, -.1}});
    EXPECT_NEAR(apart.shrunk(0, 4, 4), .2 / std::sqrt(2), 1e-15);
    EXPECT_NEAR(apart.shrunk(.2, 4, 4), .2, 1e-15);
    // A group of one organ is that organ.
    EXPECT_DOUBLE_EQ(apart.shrunk(.05, 1, 1), apart.shrunk(.05, 1));
}

TEST(PatchErrorPool, LeavesADifferenceWhereNothingIsScattered) {
    EXPECT_EQ(PatchErrorPool().shrunk(-.2, 0), .2);
    PatchErrorPool sum = pool_of({{1, .1}});
    sum += pool_of({{1, -.3}});
    EXPECT_DOUBLE_EQ(sum.shrunk(0, 1), pool_of({{1, .1}, {1, -.3}}).shrunk(0, 1));
}

}  // namespace
}  // namespace quasimc::test

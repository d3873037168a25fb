#include "solvers/bundle_budget.h"

#include <gtest/gtest.h>

namespace quasimc {
namespace {

/// So that directions grow in number as well, which otherwise would be what is left of the error.
TEST(BundleBudget, CutsPatchesBySquareRootOfVeryManyPaths) {
    constexpr std::uint64_t kMany = 1 << 16;
    EXPECT_DOUBLE_EQ(patches_for(kMany), 4 * patches_for(kMany / 4));
    EXPECT_DOUBLE_EQ(patches_for(4 * kMany), 2 * patches_for(kMany));
    EXPECT_LT(patches_for(std::uint64_t{1} << 50U), 1e7);
}

}  // namespace
}  // namespace quasimc

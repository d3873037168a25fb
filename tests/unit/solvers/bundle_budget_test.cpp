#include "solvers/bundle_budget.h"

#include <gtest/gtest.h>

namespace quasimc {
namespace {

/// So that directions grow in number as well, which otherwise would be what is left of the error.
TEST(BundleBudget, CutsPatchesBySquareRootOfVeryManyPaths) {
    constexpr std::uint64_t kMany = 1 << 16;
    EXPECT_DOUBLE_EQ(patches_for(kMany), 2 * patches_for(kMany / 2));
    EXPECT_DOUBLE_EQ(patches_for(4 * kMany), 2 * patches_for(kMany));
    EXPECT_LT(patches_for(std::uint64_t{1} << 50U), 1e7);
}

/// Of few paths as well: of 328 patches for 2,048 paths two leaves got twice the light that they
/// have on their dark sides, and told a fifth of that.
TEST(BundleBudget, CutsThousandsOfPatchesForFewPaths) {
    EXPECT_EQ(patches_for(2048), 4096);
    EXPECT_EQ(patches_for(16'384), 4096);
    EXPECT_EQ(patches_for(256), 512);
}

}  // namespace
}  // namespace quasimc

#include "geometry/mesh/closed_surface.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

std::vector<Triangle> stem(bool has_ends) {
    return make_cylinder({1, 2, 0}, {1.5, 2, 3}, .2, .1, 7, has_ends);
}

TEST(ClosedSurface, HasNoRim) {
    EXPECT_TRUE(is_closed(stem(true)));
    EXPECT_TRUE(is_closed(make_sphere({1, 2, 3}, .3, 3)));
    EXPECT_FALSE(is_closed(stem(false)));
    std::vector<Triangle> torn = stem(true);
    torn.pop_back();
    EXPECT_FALSE(is_closed(torn));
}

TEST(ClosedSurface, HasTrianglesOfOneOrientation) {
    std::vector<Triangle> turned = stem(true);
    std::swap(turned[3][0], turned[3][1]);
    EXPECT_FALSE(is_closed(turned));
}

TEST(ClosedSurface, MayHaveCornersThatDifferByRounding) {
    std::vector<Triangle> rounded = stem(true);
    rounded[2][0].x *= 1 + 1e-15;
    EXPECT_TRUE(is_closed(rounded));
    rounded[2][0].x += 1e-3;
    EXPECT_FALSE(is_closed(rounded));
}

}  // namespace
}  // namespace quasimc::test

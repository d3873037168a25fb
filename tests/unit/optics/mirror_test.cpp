#include "optics/mirror.h"

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

TEST(Mirror, ReflectsAtTheNormalAndTransmitsStraightOn) {
    const Vec3 n{0, 0, 1};
    const Vec3 wi{0.6, 0, -0.8};
    const auto mirror = make_mirror(Hemisphere::reflected);
    const auto pane = make_mirror(Hemisphere::transmitted);
    EXPECT_EQ(mirror->sample(n, wi, 0.1, 0.9), (Vec3{0.6, 0, 0.8}));
    EXPECT_EQ(pane->sample(n, wi, 0.1, 0.9), wi);
    EXPECT_TRUE(mirror->is_delta());
}

}  // namespace
}  // namespace quasimc::test

#include "light/models/hemisphere.h"

#include <cmath>

#include <gtest/gtest.h>

namespace quasimc {
namespace {

TEST(CosineDirection, HasTheSquareOfItsSineAndItsAzimuth) {
    const Vec3 straight = upward_cosine_direction(0, 0.3);
    EXPECT_EQ(straight.z, 1);
    const Vec3 d = upward_cosine_direction(0.36, 0.25);
    EXPECT_NEAR(d.x, 0, 1e-15);
    EXPECT_NEAR(d.y, 0.6, 1e-15);
    EXPECT_NEAR(d.z, 0.8, 1e-15);
}

TEST(CosineDirection, HasAMeanCosineOfTwoThirds) {
    constexpr int kSteps = 10000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        sum += upward_cosine_direction((i + .5) / kSteps, 0.1).z;
    }
    EXPECT_NEAR(sum / kSteps, 2.0 / 3, 1e-6);
}

TEST(CosineDirection, StandsAboutAnyAxis) {
    for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, normalized(Vec3{1, -2, 0.5})}) {
        const Vec3 d = cosine_direction_about(axis, 0.36, 0.7);
        EXPECT_NEAR(length(d), 1, 1e-15);
        EXPECT_NEAR(dot(d, axis), 0.8, 1e-15);
    }
    EXPECT_EQ(cosine_direction_about({0, 0, 1}, 0.36, 0.7), upward_cosine_direction(0.36, 0.7));
}

}  // namespace
}  // namespace quasimc

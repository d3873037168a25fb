#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "quasimc/mesh.h"

namespace quasimc {
namespace {

constexpr double kRounding = 1e-15;

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_NEAR(a.x, b.x, kRounding);
    EXPECT_NEAR(a.y, b.y, kRounding);
    EXPECT_NEAR(a.z, b.z, kRounding);
}

TEST(Orientation, CountsAzimuthClockwiseFromNorth) {
    const Orientation world(UpAxis::z, {0, 1, 0});
    expect_near(world.towards(0, 0), {0, 1, 0});
    expect_near(world.towards(90, 0), {1, 0, 0});  // east
    expect_near(world.towards(180, 0), {0, -1, 0});
    expect_near(world.towards(270, 0), {-1, 0, 0});
    expect_near(world.towards(-90, 0), {-1, 0, 0});
}

TEST(Orientation, CountsElevationFromTheHorizon) {
    const Orientation world;
    expect_near(world.towards(123, 90), {0, 0, 1});
    expect_near(world.towards(90, 30), {std::sqrt(0.75), 0, 0.5});
    expect_near(world.towards(0, -90), {0, 0, -1});
}

TEST(Orientation, TurnsWithNorth) {
    const Orientation north_is_x(UpAxis::z, {1, 0, 0});
    expect_near(north_is_x.towards(0, 0), {1, 0, 0});
    expect_near(north_is_x.towards(90, 0), {0, -1, 0});
    const Orientation north_east(UpAxis::z, {5, 5, 0});
    expect_near(north_east.towards(45, 0), {1, 0, 0});
}

TEST(Orientation, FollowsTheSunFromEastOverSouthToWestInTheAxesOfTheSimulators) {
    // y up, north along -z: then east is +x.
    const Orientation world(UpAxis::y, {0, 0, -1});
    expect_near(world.outward(world.towards(0, 0)), {0, 0, -1});
    expect_near(world.outward(world.towards(90, 0)), {1, 0, 0});
    expect_near(world.outward(world.towards(180, 0)), {0, 0, 1});
    expect_near(world.outward(world.towards(12, 90)), {0, 1, 0});
}

RC_GTEST_PROP(Orientation, ComesBackToTheSameBits, (double x, double y, double z)) {
    const Vec3 p{x, y, z};
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
        const Orientation world(up, {1, 0, 0});
        RC_ASSERT(world.outward(world.inward(p)) == p);
        RC_ASSERT(world.inward(world.outward(p)) == p);
    }
}

TEST(Orientation, KeepsHands) {
    const Orientation world(UpAxis::y, {1, 0, 0});
    const Vec3 x = world.inward({1, 0, 0});
    const Vec3 y = world.inward({0, 1, 0});
    const Vec3 z = world.inward({0, 0, 1});
    EXPECT_EQ(y, (Vec3{0, 0, 1}));
    EXPECT_EQ(cross(x, y), z);
}

}  // namespace
}  // namespace quasimc

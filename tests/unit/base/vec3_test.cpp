#include "base/vec3.h"

#include <array>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "quasimc/mesh.h"
#include "quasimc/scene.h"

namespace quasimc {
namespace {

void expect_frame(const Vec3& n) {
    constexpr double kFrameRounding = 1e-15;
    const Frame frame = frame_about(n);
    EXPECT_EQ(frame.n, n);
    EXPECT_NEAR(length(frame.s), 1, kFrameRounding);
    EXPECT_NEAR(length(frame.t), 1, kFrameRounding);
    EXPECT_NEAR(dot(frame.s, frame.t), 0, kFrameRounding);
    EXPECT_NEAR(dot(frame.s, n), 0, kFrameRounding);
    EXPECT_NEAR(dot(frame.t, n), 0, kFrameRounding);
    EXPECT_NEAR(dot(cross(frame.s, frame.t), n), 1, 2 * kFrameRounding);
}

TEST(FrameAbout, IsOrthonormalAndRightHandedAlongTheAxes) {
    for (const Vec3& n : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
        expect_frame(n);
        expect_frame(-n);
    }
    expect_frame({1, 0, -0.0});
}

TEST(FrameAbout, IsOrthonormalNextToTheSouthPole) {
    for (const double x : {1e-3, 1e-6, 1e-9, 1e-12, 1e-300}) {
        expect_frame(normalized({x, -x, -1}));
        expect_frame(normalized({-x, x, 1}));
        expect_frame(normalized({1, 1, x}));
        expect_frame(normalized({1, 1, -x}));
    }
}

RC_GTEST_PROP(FrameAbout, IsOrthonormalAndRightHandedAnywhere, ()) {
    const auto coordinate = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
    const double x = coordinate();
    const double y = coordinate();
    const Vec3 v{x, y, coordinate()};
    RC_PRE(length(v) > 0);
    expect_frame(normalized(v));
}

TEST(Vec3, CrossFollowsTheRightHand) {
    EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vec3{0, 0, 1}));
    EXPECT_EQ(cross({0, 1, 0}, {0, 0, 1}), (Vec3{1, 0, 0}));
    EXPECT_EQ(cross({2, 3, 5}, {2, 3, 5}), (Vec3{}));
}

TEST(Vec3, ReflectsLikeAMirror) {
    EXPECT_EQ(reflected({1, 2, -3}, {0, 0, 1}), (Vec3{1, 2, 3}));
    EXPECT_EQ(reflected({1, 2, -3}, {0, 0, -1}), (Vec3{1, 2, 3}));
}

TEST(Vec3, KnowsWhetherItIsFinite) {
    EXPECT_TRUE(is_finite({1, 2, 3}));
    EXPECT_FALSE(is_finite({1, std::numeric_limits<double>::infinity(), 3}));
    EXPECT_FALSE(is_finite({1, 2, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(Affine, TurnsThenShifts) {
    const Affine map{{Vec3{0, -1, 0}, {1, 0, 0}, {0, 0, 2}}, {10, 20, 30}};
    EXPECT_EQ(map.vector({1, 2, 3}), (Vec3{-2, 1, 6}));
    EXPECT_EQ(map.point({1, 2, 3}), (Vec3{8, 21, 36}));
    EXPECT_EQ(Affine().point({1, 2, 3}), (Vec3{1, 2, 3}));
}

TEST(Bounds, AreEmptyUntilAPointIsAdded) {
    Bounds bounds;
    EXPECT_TRUE(bounds.empty());
    bounds.add(Vec3{1, 2, 3});
    EXPECT_FALSE(bounds.empty());
    EXPECT_EQ(bounds.size(), (Vec3{}));
}

TEST(Bounds, HoldAllPoints) {
    Bounds bounds;
    bounds.add(Vec3{1, -2, 3});
    bounds.add(Vec3{-1, 2, 4});
    EXPECT_EQ(bounds.low, (Vec3{-1, -2, 3}));
    EXPECT_EQ(bounds.high, (Vec3{1, 2, 4}));
    EXPECT_EQ(bounds.center(), (Vec3{0, 0, 3.5}));
    EXPECT_DOUBLE_EQ(bounds.radius(), 0.5 * std::sqrt(4.0 + 16 + 1));
}

TEST(Ids, CompareByTheirValue) {
    EXPECT_EQ(MaterialId{3}, MaterialId{3});
    EXPECT_LT(MaterialId{3}, MaterialId{4});
}

}  // namespace
}  // namespace quasimc

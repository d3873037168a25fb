#include "geometry/shapes/shapes.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geometry_testing.h"

namespace quasimc {

namespace {

using test::Random;

constexpr double kPi = std::numbers::pi;

Vec3 total_area_vector(const std::vector<Triangle>& triangles) {
    Vec3 sum;
    for (const Triangle& t : triangles) {
        sum += 0.5 * area_vector(t);
    }
    return sum;
}

/// Volume inside a closed surface whose upper sides face outward; the negative if they face inward.
double volume(const std::vector<Triangle>& triangles) {
    double six_times = 0;
    for (const Triangle& t : triangles) {
        six_times += dot(t[0], cross(t[1], t[2]));
    }
    return six_times / 6;
}

Vec3 middle(const Triangle& t) {
    return (t[0] + t[1] + t[2]) / 3;
}

TEST(Triangle, UpperSideIsWhereCornersRunCounterClockwise) {
    const auto t = make_triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
    EXPECT_EQ(area(t), 2);
    EXPECT_EQ(total_area_vector(t), (Vec3{0, 0, 2}));
}

TEST(Parallelogram, HasTheAreaOfItsSidesProduct) {
    const auto p = make_parallelogram({1, 1, 1}, {2, 0, 0}, {1, 3, 0});
    EXPECT_EQ(p.size(), 2U);
    EXPECT_EQ(area(p), 6);
    EXPECT_EQ(total_area_vector(p), (Vec3{0, 0, 6}));
}

RC_GTEST_PROP(Rhombus, HasHalfTheAreaOfItsDiagonals, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const Vec3 along = random.point(-1, 1), up = random.direction();
    RC_PRE(length(cross(along, up)) > 0.01);
    const double width = random.between(0.1, 2);
    const auto rhombus = make_rhombus(random.point(-5, 5), along, up, width);
    RC_ASSERT(std::abs(area(rhombus) - 0.5 * width * length(along)) < 1e-12);
    const Vec3 normal = total_area_vector(rhombus);
    RC_ASSERT(dot(normal, up) > 0);
    RC_ASSERT(std::abs(dot(normal, along)) < 1e-12);
}

TEST(Rhombus, GrowsFromItsBaseToItsTip) {
    const auto rhombus = make_rhombus({1, 2, 3}, {4, 0, 0}, {0, 0, 1}, 2);
    EXPECT_EQ(rhombus[0][0], (Vec3{1, 2, 3}));
    EXPECT_EQ(rhombus[0][2], (Vec3{5, 2, 3}));
    EXPECT_EQ(rhombus[0][1], (Vec3{3, 1, 3}));
    EXPECT_EQ(rhombus[1][2], (Vec3{3, 3, 3}));
}

RC_GTEST_PROP(Cylinder, KeepsTheAreaOfTheRoundSide, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const Vec3 axis = random.point(-1, 1);
    const double r0 = random.between(0, 1), r1 = random.between(0, 1);
    const int sides = 3 + static_cast<int>(random.below(30));
    RC_PRE(length(axis) > 0.01);
    const auto side = make_cylinder(random.point(-5, 5), axis, r0, r1, sides, false);
    const double slant = std::hypot(length(axis), r0 - r1);
    RC_ASSERT(std::abs(area(side) / (kPi * (r0 + r1) * slant) - 1) < 1e-12);
}

TEST(Cylinder, UpperSidesLookOutward) {
    const Vec3 base{1, 2, 3}, axis{0.5, -1, 2};
    for (const bool capped : {false, true}) {
        const auto cylinder = make_cylinder(base, axis, 0.3, 0.1, 7, capped);
        const Vec3 center = base + 0.4 * axis;
        for (const Triangle& t : cylinder) {
            EXPECT_GT(dot(area_vector(t), middle(t) - center), 0);
        }
        EXPECT_EQ(cylinder.size(), capped ? 24U : 14U);
    }
}

TEST(Cylinder, WithCapsIsClosed) {
    for (const double top : {0.0, 0.1, 0.3}) {
        const auto closed = make_cylinder({1, 2, 3}, {0.5, -1, 2}, 0.3, top, 9, true);
        EXPECT_LT(length(total_area_vector(closed)), 1e-14);
        const auto open = make_cylinder({1, 2, 3}, {0.5, -1, 2}, 0.3, top, 9, false);
        EXPECT_GT(length(total_area_vector(open)), 1e-3 * (top == 0.3 ? 0 : 1));
    }
}

TEST(Cylinder, AConeHasNoTrianglesWithoutArea) {
    for (const auto& [base, top] : {std::pair{0.5, 0.0}, std::pair{0.0, 0.5}}) {
        const auto cone = make_cylinder({}, {0, 0, 1}, base, top, 6, false);
        EXPECT_EQ(cone.size(), 6U);
        for (const Triangle& t : cone) {
            EXPECT_GT(area(t), 0.1);
        }
    }
}

TEST(Cylinder, OfManySidesHasTheRadiusAsked) {
    const auto cylinder = make_cylinder({}, {0, 0, 1}, 0.5, 0.5, 500, false);
    for (const Triangle& t : cylinder) {
        for (const Vec3& corner : t) {
            EXPECT_NEAR(std::hypot(corner.x, corner.y), 0.5, 1e-5);
        }
    }
}

TEST(Cylinder, WithoutLengthOrRadiusHasNoArea) {
    EXPECT_EQ(area(make_cylinder({1, 1, 1}, {}, 0.5, 0.5, 5, false)), 0);
    EXPECT_EQ(area(make_cylinder({1, 1, 1}, {0, 0, 1}, 0, 0, 5, true)), 0);
}

TEST(Disk, KeepsTheAreaOfTheRoundDisk) {
    for (const int sides : {3, 4, 5, 12, 100}) {
        const Vec3 normal = normalized(Vec3{1, -2, 0.5});
        const auto disk = make_disk({4, 5, 6}, 3 * normal, 0.7, sides);
        EXPECT_NEAR(area(disk), kPi * 0.49, 1e-12);
        EXPECT_LT(length(total_area_vector(disk) - kPi * 0.49 * normal), 1e-12);
    }
}

TEST(Sphere, KeepsTheAreaOfTheTrueSphere) {
    for (int levels = 0; levels < 4; ++levels) {
        const auto sphere = make_sphere({1, 2, 3}, 0.5, levels);
        EXPECT_EQ(sphere.size(), 20U << (2 * levels));
        EXPECT_NEAR(area(sphere), kPi, 1e-12);
        EXPECT_LT(length(total_area_vector(sphere)), 1e-14);
        EXPECT_GT(volume(sphere), 0);
    }
    EXPECT_NEAR(volume(make_sphere({}, 0.5, 5)), kPi / 6, 1e-3);
}

TEST(Sphere, UpperSidesLookOutward) {
    for (const Triangle& t : make_sphere({1, 2, 3}, 0.5, 2)) {
        EXPECT_GT(dot(area_vector(t), middle(t) - Vec3{1, 2, 3}), 0);
    }
}

}  // namespace

}  // namespace quasimc

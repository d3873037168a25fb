#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geometry/shapes/ear_cutter.h"
#include "geometry/shapes/shapes.h"
#include "geometry_testing.h"
#include "quasimc/error.h"

namespace quasimc {

namespace {

using test::Random;

/// The area of a polygon in the xy plane, by the shoelace formula; negative if clockwise.
double shoelace(const std::vector<Vec3>& corners) {
    double twice = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return twice / 2;
}

/// Whether the triangles make up the polygon: the same area, none turned over.
::testing::AssertionResult fills(
    const std::vector<Triangle>& triangles,
    const std::vector<Vec3>& corners,
    double tolerance = 1e-12) {
    const double expected = shoelace(corners);
    double sum = 0;
    for (const Triangle& t : triangles) {
        const double signed_area = 0.5 * area_vector(t).z;
        if (signed_area * expected < 0) {
            return ::testing::AssertionFailure() << "a triangle is turned over";
        }
        sum += signed_area;
    }
    if (std::abs(sum - expected) > tolerance * std::abs(expected)) {
        return ::testing::AssertionFailure() << sum << " instead of " << expected;
    }
    return ::testing::AssertionSuccess();
}

/// A polygon of any number of corners that sees its center from all of them.
std::vector<Vec3> star(std::size_t count, Random& random) {
    std::vector<Vec3> corners;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi *
                             (static_cast<double>(i) + 0.5 * random.uniform()) /
                             static_cast<double>(count);
        const double radius = random.between(0.1, 1);
        corners.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    return corners;
}

RC_GTEST_PROP(Polygon, OfAnyShapeIsFilled, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    auto corners = star(3 + random.below(60), random);
    if (random.below(2) == 0) {
        std::reverse(corners.begin(), corners.end());
    }
    RC_PRE(std::abs(shoelace(corners)) > 0.01);
    const auto triangles = make_polygon(corners);
    RC_ASSERT(fills(triangles, corners));
    RC_ASSERT(triangles.size() == corners.size() - 2);
}

TEST(Polygon, FillingNoticesAMissingAndATurnedTriangle) {
    Random random(101);
    const auto corners = star(10, random);
    auto triangles = make_polygon(corners);
    std::swap(triangles[3][0], triangles[3][1]);
    EXPECT_FALSE(fills(triangles, corners));
    triangles = make_polygon(corners);
    triangles.pop_back();
    EXPECT_FALSE(fills(triangles, corners));
}

RC_GTEST_PROP(Polygon, MayLieInAnyPlane, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const auto flat = star(3 + random.below(20), random);
    const Frame frame = frame_about(normalized(random.direction()));
    const Vec3 position = random.point(-100, 100);
    std::vector<Vec3> corners;
    for (const Vec3& p : flat) {
        corners.push_back(position + p.x * frame.s + p.y * frame.t);
    }
    RC_PRE(shoelace(flat) > 0.01);
    const auto triangles = make_polygon(corners);
    RC_ASSERT(std::abs(area(triangles) - shoelace(flat)) < 1e-9);
    for (const Triangle& t : triangles) {
        RC_ASSERT(dot(area_vector(t), frame.n) > -1e-12);
    }
}

/// Corners on a coarse grid: repeated ones, straight sides and spikes, sides that touch and cross.
std::vector<FlatCorner> on_grid(const std::vector<Vec3>& corners, double cells) {
    std::vector<FlatCorner> flat;
    for (const Vec3& p : corners) {
        const FlatCorner corner{
            {std::round(cells * p.x) / cells, std::round(cells * p.y) / cells}, flat.size()};
        if (flat.empty() || !same_point(flat.back(), corner)) {
            flat.push_back(corner);
        }
    }
    return flat;
}

RC_GTEST_PROP(Polygon, OfManyCornersIsCutAsOneOfFew, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const double cells = std::exp2(static_cast<double>(2 + random.below(40)));
    const auto corners = on_grid(star(3 + random.below(120), random), cells);
    RC_PRE(corners.size() >= 3U);
    const auto few = cut_ears_of_few(corners), many = cut_ears_of_many(corners);
    RC_ASSERT(few == many);
    RC_TAG(few.has_value() ? "cut" : "refused");
}

/// A hundred thousand corners: testing all of them for each ear would take hours.
TEST(Polygon, OfVeryManyCornersIsFilled) {
    constexpr std::size_t kMany = 100000;
    Random random(7);
    std::vector<Vec3> circle, comb{{static_cast<double>(kMany), -1, 0}, {0, -1, 0}};
    for (std::size_t i = 0; i < kMany; ++i) {
        const double x = static_cast<double>(i), angle = 2 * std::numbers::pi * x / kMany;
        circle.push_back({std::cos(angle), std::sin(angle), 0});
        comb.push_back({x, i % 2 == 0 ? 0.0 : 10.0, 0});
    }
    for (const auto& corners : {circle, comb, star(kMany, random)}) {
        const auto triangles = make_polygon(corners);
        EXPECT_EQ(triangles.size(), corners.size() - 2);
        constexpr double kRounding = 1e-16;  // of each triangle
        EXPECT_TRUE(fills(triangles, corners, kRounding * kMany));
    }
}

TEST(Polygon, ASpiralIsFilled) {
    std::vector<Vec3> corners;
    for (int i = 0; i <= 100; ++i) {
        const double angle = 0.2 * i;
        corners.push_back({angle * std::cos(angle), angle * std::sin(angle), 0});
    }
    for (int i = 100; i > 0; --i) {
        const double angle = 0.2 * i;
        corners.push_back({(angle + 1) * std::cos(angle), (angle + 1) * std::sin(angle), 0});
    }
    EXPECT_TRUE(fills(make_polygon(corners), corners));
}

TEST(Polygon, CornersOnStraightSidesDoNoHarm) {
    std::vector<Vec3> corners;
    for (int side = 0; side < 4; ++side) {
        const double angle = std::numbers::pi / 2 * side;
        const Vec3 along{std::round(std::cos(angle)), std::round(std::sin(angle)), 0};
        for (int i = 0; i < 5; ++i) {
            corners.push_back(Vec3{-along.x + along.y, -along.y - along.x, 0} + (0.4 * i) * along);
        }
    }
    EXPECT_NEAR(std::abs(shoelace(corners)), 4, 1e-12);
    EXPECT_TRUE(fills(make_polygon(corners), corners));
}

TEST(Polygon, RepeatedCornersAndAClosingOneDoNoHarm) {
    const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0},
                                    {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
    const auto triangles = make_polygon(corners);
    EXPECT_TRUE(fills(triangles, corners));
    EXPECT_EQ(triangles.size(), 2U);
}

TEST(Polygon, ASpikeIsRemoved) {
    const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {3, 0, 0},
                                    {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_TRUE(fills(make_polygon(corners), corners));
}

TEST(Polygon, AHoleReachedByABridgeIsLeftOpen) {
    // The outer square, a bridge, the inner square the other way round, and the bridge back.
    const std::vector<Vec3> corners{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                    {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
    const auto triangles = make_polygon(corners);
    EXPECT_NEAR(shoelace(corners), 12, 1e-12);
    EXPECT_TRUE(fills(triangles, corners));
    for (const Triangle& t : triangles) {
        const Vec3 middle = (t[0] + t[1] + t[2]) / 3;
        EXPECT_FALSE(middle.x > 1 && middle.x < 3 && middle.y > 1 && middle.y < 3);
    }
}

TEST(Polygon, UpperSideIsTheOneFromWhichCornersRunCounterClockwise) {
    std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (const Triangle& t : make_polygon(corners)) {
        EXPECT_GT(area_vector(t).z, 0);
    }
    std::reverse(corners.begin(), corners.end());
    for (const Triangle& t : make_polygon(corners)) {
        EXPECT_LT(area_vector(t).z, 0);
    }
}

TEST(Polygon, CornersNotQuiteInAPlaneAreKept) {
    const std::vector<Vec3> corners{
        {0, 0, 0}, {1, 0, 0.01}, {1, 1, -0.01}, {0, 1, 0.01}, {-0.5, 0.5, 0}};
    const auto triangles = make_polygon(corners);
    EXPECT_EQ(triangles.size(), 3U);
    for (const Vec3& corner : corners) {
        const bool is_used = std::any_of(
            triangles.begin(), triangles.end(),
            [&](const Triangle& t) { return std::find(t.begin(), t.end(), corner) != t.end(); });
        EXPECT_TRUE(is_used);
    }
    EXPECT_NEAR(area(triangles), shoelace(corners), 1e-3);
}

TEST(Polygon, OnALineHasNoArea) {
    const std::vector<Vec3> corners{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
    const auto triangles = make_polygon(corners);
    ASSERT_FALSE(triangles.empty());
    EXPECT_EQ(area(triangles), 0);
}

TEST(Polygon, WhoseSidesCrossIsRefused) {
    const std::vector<Vec3> pentagram{
        {0, 1, 0}, {0.59, -0.81, 0}, {-0.95, 0.31, 0}, {0.95, 0.31, 0}, {-0.59, -0.81, 0}};
    EXPECT_THROW((void)make_polygon(pentagram), InputError);
    EXPECT_TRUE(cut_polygon(pentagram).sides_cross);
    EXPECT_EQ(cut_polygon(pentagram).faces, (std::vector<Face>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

// Wings of equal size cancel in the vector area: such a face once became one triangle.
TEST(Polygon, OfABowTieIsAFan) {
    const std::vector<Vec3> equal{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<Vec3> unequal{{0, 0, 0}, {1, 1, 0}, {1, 0.2, 0}, {0, 1, 0}};
    for (const auto& corners : {equal, unequal}) {
        const CutPolygon cut = cut_polygon(corners);
        EXPECT_TRUE(cut.sides_cross);
        EXPECT_EQ(cut.faces, (std::vector<Face>{{0, 1, 2}, {0, 2, 3}}));
        EXPECT_THROW((void)make_polygon(corners), InputError);
    }
}

// A hole, cut open along a bridge that is passed twice: its sides touch, none crosses.
TEST(Polygon, WhoseSidesTouchIsCutByItsEars) {
    const std::vector<Vec3> holed{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                                  {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
    EXPECT_FALSE(cut_polygon(holed).sides_cross);
    EXPECT_NEAR(area(make_polygon(holed)), 8, 1e-12);
}

}  // namespace

}  // namespace quasimc

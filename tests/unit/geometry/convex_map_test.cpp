#include "raster/convex_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geometry_testing.h"

namespace quasimc {

namespace {

using test::Random;

std::vector<Point2> random_points(std::size_t count, Random& random) {
    std::vector<Point2> points;
    const double width = std::pow(10.0, random.between(-3, 0));
    for (std::size_t i = 0; i < count; ++i) {
        points.push_back({random.between(-1, 1), width * random.between(-1, 1)});
    }
    return points;
}

/// How far `p` lies outside a polygon whose corners run counter-clockwise; negative inside.
double distance_outside(const std::vector<Point2>& polygon, const Point2& p) {
    double outside = -INFINITY;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double length = std::hypot(b.s - a.s, b.t - a.t);
        const double left = (b.s - a.s) * (p.t - a.t) - (b.t - a.t) * (p.s - a.s);
        outside = std::max(outside, -left / length);
    }
    return outside;
}

RC_GTEST_PROP(ConvexHull, HoldsAllPointsAndTurnsLeft, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const auto points = random_points(3 + random.below(300), random);
    const auto hull = convex_hull(points);
    RC_ASSERT(hull.size() >= 3U);
    RC_ASSERT(polygon_area(hull) > 0);
    for (const Point2& p : points) {
        RC_ASSERT(distance_outside(hull, p) < 1e-12);
    }
    for (const Point2& corner : hull) {
        RC_ASSERT(std::any_of(points.begin(), points.end(), [&](const Point2& p) {
            return p.s == corner.s && p.t == corner.t;
        }));
    }
}

TEST(Turn, IsTwiceTheAreaOfATriangleAndItsSense) {
    EXPECT_EQ(turn({1, 1}, {3, 1}, {1, 4}), 6);
    EXPECT_EQ(turn({1, 1}, {1, 4}, {3, 1}), -6);
    EXPECT_EQ(turn({0, 0}, {1, 1}, {2, 2}), 0);
}

TEST(ConvexHull, OfPointsOnALineHasFewerThanThreeCorners) {
    std::vector<Point2> points;
    for (int i = 0; i < 100; ++i) {
        points.push_back({i / 128.0, i / 64.0});
    }
    EXPECT_LT(convex_hull(points).size(), 3U);
    EXPECT_EQ(convex_hull({{1, 2}, {1, 2}}).size(), 1U);
    EXPECT_EQ(polygon_area(convex_hull(points)), 0);
}

TEST(ConvexHull, LeavesOutPointsOnItsSides) {
    EXPECT_EQ(
        convex_hull({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}, {1, 1}}).size(), 4U);
}

std::vector<std::vector<Point2>> polygons() {
    std::vector<std::vector<Point2>> all{
        {{0, 0}, {2, 0}, {2, 1}, {0, 1}},            // upright sides at both ends
        {{0, 0}, {1, 0}, {0, 1}},                    // at one
        {{0, 0}, {1, -1}, {1, 1}},                   // at the other
        {{-1, 0}, {0, -1}, {1, 0}, {0, 1}},          // at none
        {{0, 0}, {1, 0}, {1 + 1e-9, 1}, {1e-9, 1}},  // nearly upright
        {{0, 0}, {1, 1e-6}, {0.5, 2e-6}},            // thin
    };
    std::vector<Point2> round;
    for (int i = 0; i < 101; ++i) {
        const double angle = 2 * std::numbers::pi * i / 101;
        round.push_back({3 * std::cos(angle), std::sin(angle)});
    }
    all.push_back(round);
    return all;
}

TEST(ConvexMap, KnowsTheAreaOfThePolygon) {
    for (const auto& polygon : polygons()) {
        EXPECT_NEAR(
            ConvexMap(polygon).area(), polygon_area(polygon), 1e-12 * polygon_area(polygon));
    }
}

/// The area of the part of a polygon with s < a (clipped as by Sutherland and Hodgman).
double area_left_of(const std::vector<Point2>& polygon, double a) {
    std::vector<Point2> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        if (p.s < a) {
            part.push_back(p);
        }
        if ((p.s < a) != (q.s < a)) {
            part.push_back({a, p.t + (q.t - p.t) * (a - p.s) / (q.s - p.s)});
        }
    }
    return part.size() < 3 ? 0 : polygon_area(part);
}

TEST(ConvexMap, SweepsEqualAreasExactly) {
    for (const auto& polygon : polygons()) {
        const ConvexMap map(polygon);
        for (int i = 0; i <= 1000; ++i) {
            const double u = i / 1000.0;
            EXPECT_NEAR(
                area_left_of(polygon, map.point(u, 0.5).s), u * map.area(), 1e-9 * map.area());
        }
    }
}

TEST(ConvexMap, RunsFromBorderToBorderAlongChords) {
    for (const auto& polygon : polygons()) {
        const ConvexMap map(polygon);
        for (int i = 1; i < 100; ++i) {
            const Point2 low = map.point(i / 100.0, 0), high = map.point(i / 100.0, 1);
            const Point2 middle = map.point(i / 100.0, 0.5);
            EXPECT_EQ(low.s, high.s);
            EXPECT_NEAR(middle.t, 0.5 * (low.t + high.t), 1e-12);
            EXPECT_NEAR(distance_outside(polygon, low), 0, 1e-9);
            EXPECT_NEAR(distance_outside(polygon, high), 0, 1e-9);
        }
    }
}

TEST(ConvexMap, NeighboursStayNeighbours) {
    const auto polygon = polygons().back();
    const ConvexMap map(polygon);
    constexpr int kSteps = 100000;
    Point2 last = map.point(0, 0.3);
    for (int i = 1; i <= kSteps; ++i) {
        const Point2 p = map.point(static_cast<double>(i) / kSteps, 0.3);
        // Near a corner the map is steep: as the square root of the area.
        EXPECT_LT(std::hypot(p.s - last.s, p.t - last.t), 5 / std::sqrt(kSteps));
        EXPECT_GE(p.s, last.s);
        last = p;
    }
}

/// The largest difference between the fraction of points on one side of a line and the fraction of
/// the polygon on that side, over lines through the middle. u0 is raised to `skew`: 1 for the map
/// as it is.
double worst_side(const std::vector<Point2>& polygon, double skew) {
    const ConvexMap map(polygon);
    std::array<double, 16> left{}, right{};
    constexpr int kPoints = 1 << 16;
    // Halves of the polygon cut by lines through its middle, at sixteen angles.
    const double s0 = map.point(0.5, 0.5).s, t0 = map.point(0.5, 0.5).t;
    for (int i = 0; i < kPoints; ++i) {
        const double u0 = std::pow((i + 0.5) / kPoints, skew);
        const double u1 = std::fmod(i * 0.6180339887498949, 1.0);
        const Point2 p = map.point(u0, u1);
        for (std::size_t k = 0; k < 16; ++k) {
            const double angle = std::numbers::pi * static_cast<double>(k) / 16;
            const bool is_left = std::cos(angle) * (p.s - s0) + std::sin(angle) * (p.t - t0) < 0;
            (is_left ? left : right)[k] += 1.0 / kPoints;
        }
    }
    double worst = 0;
    for (std::size_t k = 0; k < 16; ++k) {
        const double angle = std::numbers::pi * static_cast<double>(k) / 16;
        std::vector<Point2> turned;
        for (const Point2& p : polygon) {
            turned.push_back(
                {std::cos(angle) * (p.s - s0) + std::sin(angle) * (p.t - t0),
                 -std::sin(angle) * (p.s - s0) + std::cos(angle) * (p.t - t0)});
        }
        worst =
            std::max(worst, std::abs(left[k] - area_left_of(turned, 0) / polygon_area(polygon)));
    }
    return worst;
}

TEST(ConvexMap, KeepsAreasOnBothSidesOfAnyLine) {
    for (const auto& polygon : polygons()) {
        EXPECT_LT(worst_side(polygon, 1), 1e-3);
    }
}

TEST(ConvexMap, AreasOnBothSidesOfALineShowASkewedMap) {
    for (const auto& polygon : polygons()) {
        EXPECT_GT(worst_side(polygon, 1.1), 1e-2);
    }
}

}  // namespace

}  // namespace quasimc

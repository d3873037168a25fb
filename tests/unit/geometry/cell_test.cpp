#include "geometry/mesh/cell.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geometry_testing.h"
#include "quasimc/error.h"

namespace quasimc {

namespace {

using test::Random;

const Cell unit_cell{true, true, 0, 0, 1, 1};

Triangle triangle_at(double x, double y, double size) {
    return {Vec3{x, y, 0}, Vec3{x + size, y, 0}, Vec3{x, y + size, 0.1}};
}

std::size_t images(const Triangle& t, const Cell& cell) {
    return wrap_into_cell({t}, cell).triangles.size();
}

TEST(WrapIntoCell, ATriangleInsideStaysAsItIs) {
    const Triangle t = triangle_at(0.3, 0.3, 0.2);
    const WrappedTriangles wrapped = wrap_into_cell({t}, unit_cell);
    ASSERT_EQ(wrapped.triangles.size(), 1U);
    EXPECT_EQ(wrapped.triangles[0], t);
    EXPECT_EQ(wrapped.source[0], 0U);
}

TEST(WrapIntoCell, ATriangleOverABorderAppearsOnBothSides) {
    EXPECT_EQ(images(triangle_at(0.9, 0.3, 0.2), unit_cell), 2U);
    EXPECT_EQ(images(triangle_at(0.3, -0.1, 0.2), unit_cell), 2U);
}

TEST(WrapIntoCell, ATriangleOverACornerAppearsInTheCellsItTouchesOnly) {
    // Its bounds reach into four cells; the triangle itself leaves one of them out.
    EXPECT_EQ(images(triangle_at(0.8, 0.8, 0.5), unit_cell), 4U);
    EXPECT_EQ(images(triangle_at(0.8, 0.8, 0.3), unit_cell), 3U);
}

TEST(WrapIntoCell, ATriangleFarOutsideIsMovedInside) {
    const WrappedTriangles wrapped = wrap_into_cell({triangle_at(17.25, -40.75, 0.125)}, unit_cell);
    ASSERT_EQ(wrapped.triangles.size(), 1U);
    EXPECT_EQ(wrapped.triangles[0], triangle_at(0.25, 0.25, 0.125));
}

TEST(WrapIntoCell, OnlyPeriodicAxesAreWrapped) {
    const Triangle t = triangle_at(2.3, 5.9, 0.2);
    EXPECT_EQ(wrap_into_cell({t}, {true, false, 0, 0, 1, 1}).triangles[0][0].y, 5.9);
    EXPECT_EQ(wrap_into_cell({t}, {false, true, 0, 0, 1, 1}).triangles[0][0].x, 2.3);
    EXPECT_EQ(images(t, {true, false, 0, 0, 1, 1}), 1U);
    EXPECT_EQ(images(t, {false, true, 0, 0, 1, 1}), 2U);
}

TEST(WrapIntoCell, UprightTrianglesAreWrappedToo) {
    const Triangle wall{Vec3{0.5, -0.2, 0}, Vec3{0.5, 0.2, 0}, Vec3{0.5, 0, 1}};
    EXPECT_EQ(images(wall, unit_cell), 2U);
    const Triangle slanting{Vec3{0.9, 0.8, 0}, Vec3{1.2, 1.1, 0}, Vec3{1.05, 0.95, 1}};
    EXPECT_EQ(images(slanting, unit_cell), 3U);
}

TEST(WrapIntoCell, ATriangleOfManyCellsAppearsOncePerCellItTouches) {
    const std::size_t count = images(triangle_at(0.01, 0.01, 100), unit_cell);
    EXPECT_GT(count, 5000U);
    EXPECT_LT(count, 5200U);  // half of 100 x 100 and the cells along the long side
}

TEST(WrapIntoCell, AnAbsurdlyLargeTriangleIsRefusedByName) {
    try {
        (void)wrap_into_cell({triangle_at(0, 0, 0.1), triangle_at(0, 0, 1e7)}, unit_cell);
        FAIL() << "not refused";
    } catch (const InputError& error) {
        ASSERT_EQ(error.faults().size(), 1U);
        EXPECT_EQ(error.faults()[0].where, "triangle 2");
    }
}

TEST(WrapIntoCell, ImagesOfOneTriangleStandTogether) {
    Random random(51);
    const WrappedTriangles wrapped = wrap_into_cell(test::random_soup(200, 1.5, random), unit_cell);
    for (std::size_t i = 1; i < wrapped.source.size(); ++i) {
        EXPECT_TRUE(
            wrapped.source[i] == wrapped.source[i - 1] ||
            wrapped.source[i] == wrapped.source[i - 1] + 1);
    }
}

/// Whether the point (x, y) lies under the triangle.
bool covers(const Triangle& t, double x, double y) {
    int turns = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = t[i], &b = t[(i + 1) % 3];
        turns += (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0 ? 1 : 0;
    }
    return turns == 0 || turns == 3;
}

/// How many triangles of the infinite scene lie above a point, for each input triangle.
std::map<std::size_t, int> cover_of_copies(
    const std::vector<Triangle>& triangles, const Cell& cell, double x, double y) {
    std::map<std::size_t, int> cover;
    constexpr int kReach = 12, kAcross = 2 * kReach + 1;
    for (int n = 0; n < kAcross * kAcross; ++n) {
        const int row = n / kAcross - kReach, column = n % kAcross - kReach;
        if ((row != 0 && !cell.along_y) || (column != 0 && !cell.along_x)) {
            continue;
        }
        for (std::size_t k = 0; k < triangles.size(); ++k) {
            if (covers(triangles[k], x + column * cell.size_x, y + row * cell.size_y)) {
                ++cover[k];
            }
        }
    }
    return cover;
}

RC_GTEST_PROP(WrapIntoCell, CoversEveryPointAsTheInfiniteSceneDoes, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const Cell cell{*rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(),
                    random.between(-3, 3),       random.between(-3, 3),
                    random.between(0.5, 2),      random.between(0.5, 2)};
    RC_PRE(cell.periodic());
    const auto triangles = test::random_soup(3, std::pow(10.0, random.between(-1, 0.5)), random);
    const WrappedTriangles wrapped = wrap_into_cell(triangles, cell);
    for (int i = 0; i < 50; ++i) {
        const double x = cell.low_x + cell.size_x * random.uniform();
        const double y = cell.low_y + cell.size_y * random.uniform();
        std::map<std::size_t, int> cover;
        for (std::size_t k = 0; k < wrapped.triangles.size(); ++k) {
            if (covers(wrapped.triangles[k], x, y)) {
                ++cover[wrapped.source[k]];
            }
        }
        RC_ASSERT(cover == cover_of_copies(triangles, cell, x, y));
    }
}

}  // namespace

}  // namespace quasimc

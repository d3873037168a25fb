#include "geometry/mesh/outline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geometry/shapes/shapes.h"
#include "geometry_testing.h"

namespace quasimc {

namespace {

using test::Random;
using test::reach;
using test::vertices;

/// Whether the outline reaches as far as the mesh in every direction.
::testing::AssertionResult reaches_as_far(
    const std::vector<Vec3>& outline, const LocalMesh& mesh, Random& random) {
    const auto all = vertices(mesh);
    for (int i = 0; i < 200; ++i) {
        Vec3 d = random.direction();
        d = i < 3 ? Vec3{i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0} : d;
        if (reach(outline, d) != reach(all, d)) {
            return ::testing::AssertionFailure() << "along " << d.x << " " << d.y << " " << d.z;
        }
    }
    return ::testing::AssertionSuccess();
}

TEST(OutlinePoints, ReachAsFarAsTheMesh) {
    Random random(71);
    for (const std::size_t count : {1U, 2U, 10U, 1000U, 20000U}) {
        for (const double size : {0.01, 0.3}) {
            const LocalMesh mesh = make_local_mesh(test::random_soup(count, size, random));
            EXPECT_TRUE(reaches_as_far(outline_points(mesh), mesh, random)) << count;
        }
    }
}

TEST(OutlinePoints, OfRoundAndOfFlatScenesReachAsFarAsTheMesh) {
    Random random(72);
    const LocalMesh round = make_local_mesh(make_sphere({1, 2, 3}, 2, 4));
    EXPECT_TRUE(reaches_as_far(outline_points(round), round, random));
    auto flat = test::random_soup(2000, 0.02, random);
    for (Triangle& t : flat) {
        for (Vec3& corner : t) {
            corner.z = 5;
        }
    }
    const LocalMesh mesh = make_local_mesh(flat);
    const auto outline = outline_points(mesh);
    EXPECT_TRUE(reaches_as_far(outline, mesh, random));
    EXPECT_LT(outline.size(), 2000U);
}

TEST(OutlinePoints, AreFewOfALargeScene) {
    Random random(73);
    const LocalMesh mesh = make_local_mesh(test::random_soup(100000, 0.01, random));
    EXPECT_LT(outline_points(mesh).size(), 75000U);  // of 300000
}

/// Whether the outline of points reaches as far as they do. @param cells  of the grid
::testing::AssertionResult is_outline(
    const std::vector<Vec3>& outline, const std::vector<Vec3>& points, Random& random) {
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = random.direction();
        if (reach(outline, d) != reach(points, d)) {
            return ::testing::AssertionFailure() << "along " << d.x << " " << d.y << " " << d.z;
        }
    }
    return ::testing::AssertionSuccess();
}

TEST(OutlinePoints, OfAPlantAreLittleMoreThanTheCornersOfItsHull) {
    Random random(75);
    std::vector<Vec3> plant;  // tips of leaves about a stem, and points between
    for (int i = 0; i < 2000; ++i) {
        const double along = random.uniform();
        plant.push_back(
            Vec3{0, 0, 1} + along * (1 - along / 2) * random.direction() + Vec3{0, 0, 1e-3 * i});
    }
    const std::vector<Vec3> outline = outline_points(plant, plant.size());
    EXPECT_TRUE(is_outline(outline, plant, random));
    EXPECT_LT(outline.size(), 300U);
    EXPECT_EQ(outline_points(outline, outline.size()).size(), outline.size());
}

TEST(OutlinePoints, OfPointsOnFacesEdgesLinesAndASpotReachAsFar) {
    Random random(76);
    const std::array<Vec3, 4> extents{Vec3{1, 2, 3}, {1, 2, 0}, {1, 0, 0}, {0, 0, 0}};
    for (const Vec3& extent : extents) {
        for (const double far : {0., 1e6}) {
            std::vector<Vec3> points;
            for (int i = 0; i < 1000; ++i) {  // a grid of 10 x 10 x 10 has many in one plane
                points.push_back(
                    Vec3{far, 0, 0} + Vec3{
                                          extent.x * (i % 10), extent.y * (i / 10 % 10),
                                          extent.z * std::floor(i / 100.)});
            }
            const std::vector<Vec3> outline = outline_points(points, points.size());
            EXPECT_TRUE(is_outline(outline, points, random))
                << extent.x << " " << extent.y << " " << extent.z << " " << far;
        }
    }
}

TEST(OutlinePoints, ComparisonOfReachNoticesAMissingCorner) {
    Random random(74);
    const LocalMesh mesh = make_local_mesh(test::random_soup(100, 0.1, random));
    auto outline = outline_points(mesh);
    const auto furthest = std::max_element(
        outline.begin(), outline.end(), [](const Vec3& a, const Vec3& b) { return a.x < b.x; });
    outline.erase(furthest);
    EXPECT_FALSE(reaches_as_far(outline, mesh, random));
}

}  // namespace

}  // namespace quasimc

#include "geometry/mesh/local_mesh.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geometry_testing.h"

namespace quasimc {

namespace {

using test::Random;

double largest_coordinate(const LocalMesh& mesh) {
    double largest = 0;
    for (const float c : mesh.vertices) {
        largest = std::max(largest, std::abs(static_cast<double>(c)));
    }
    return largest;
}

RC_GTEST_PROP(LocalMesh, FillsTheUnitCubeWhateverSizeAndPosition, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const double size = std::pow(10.0, *rc::gen::inRange(-12, 13));
    const Vec3 position = size * random.point(-1000, 1000);
    std::vector<Triangle> triangles;
    for (const Triangle& t : test::random_soup(3, 0.5, random)) {
        triangles.push_back(
            {position + size * t[0], position + size * t[1], position + size * t[2]});
    }
    const LocalMesh mesh = make_local_mesh(triangles);
    RC_ASSERT(mesh.triangle_count() == 3U);
    RC_ASSERT(largest_coordinate(mesh) <= 1);
    RC_ASSERT(largest_coordinate(mesh) > 0.5 - 1e-6);
    int exponent = 0;
    RC_ASSERT(std::frexp(mesh.scale, &exponent) == 0.5);
}

TEST(LocalMesh, KeepsCornersToSinglePrecision) {
    Random random(1);
    const auto soup = test::random_soup(50, 0.3, random);
    const LocalMesh mesh = make_local_mesh(soup);
    for (std::uint32_t i = 0; i < 50; ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            const Vec3 exact = mesh.to_local(soup[i][static_cast<std::size_t>(corner)]);
            EXPECT_LT(length(mesh.vertex(i, corner) - exact), 0x1p-24);
        }
    }
}

TEST(LocalMesh, PlacesPointsByBarycentricCoordinates) {
    const LocalMesh mesh = make_local_mesh({{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{0, 2, 0}}});
    EXPECT_EQ(mesh.point(0, 0, 0), mesh.to_local({0, 0, 0}));
    EXPECT_EQ(mesh.point(0, 0.5, 0), mesh.to_local({1, 0, 0}));
    EXPECT_EQ(mesh.point(0, 0.25, 0.5), mesh.to_local({0.5, 1, 0}));
}

TEST(LocalMesh, AnExtentThatIsAPowerOfTwoFillsTheCubeExactly) {
    const LocalMesh mesh = make_local_mesh({{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 1, 0}}});
    EXPECT_EQ(mesh.scale, 0.5);
    EXPECT_EQ(largest_coordinate(mesh), 1);
}

TEST(LocalMesh, ASceneOfOnePointStaysAsItIs) {
    const Vec3 p{3, 4, 5};
    const LocalMesh mesh = make_local_mesh({{p, p, p}});
    EXPECT_EQ(mesh.scale, 1);
    EXPECT_EQ(mesh.vertex(0, 2), Vec3{});
}

/// Corrections for light at a slope rely on this bound: no triangle may be turned by more.
RC_GTEST_PROP(LocalMesh, KnowsHowFarRoundingTurnsItsTriangles, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const double size = std::pow(10.0, *rc::gen::inRange(-3, 1));
    std::vector<Triangle> triangles;
    for (const Triangle& t : test::random_soup(20, 0.5, random)) {
        const Vec3 position = random.point(-1, 1);
        triangles.push_back(
            {position + size * t[0], position + size * t[1], position + size * t[2]});
    }
    const LocalMesh mesh = make_local_mesh(triangles);
    double most = 0;
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        const Vec3 rounded = mesh.across(i);
        const Vec3 given = mesh.scale * mesh.scale * area_vector(triangles[i]);
        if (!mesh.thin.contains(i) && length(rounded) > 0) {
            most = std::max(most, length(rounded - given) / length(rounded));
        }
    }
    RC_ASSERT(std::abs(mesh.most_turned - most) <= 1e-6 * most);
    RC_ASSERT(mesh.most_turned <= 1e-3);
    RC_ASSERT(most > 0);
}

}  // namespace

}  // namespace quasimc

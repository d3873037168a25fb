#include "geometry_testing.h"

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace quasimc::test {

namespace {

const Triangle floor_triangle{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};

TEST(FirstHitAmongCopies, FindsTheNearestTriangle) {
    const Triangle above{Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0, 1, 1}};
    const FirstHit hit =
        first_hit_among_copies({floor_triangle, above}, Cell{}, 0, {0.2, 0.3, 3}, {0, 0, -1}, 0);
    EXPECT_TRUE(hit.found);
    EXPECT_FALSE(hit.is_close_call);
    EXPECT_EQ(hit.triangle, 1U);
    EXPECT_DOUBLE_EQ(hit.t, 2);
}

TEST(FirstHitAmongCopies, FindsTrianglesInOtherCellsOfPeriodicAxesOnly) {
    const auto found = [](const Cell& cell, const Vec3& origin) {
        return first_hit_among_copies({floor_triangle}, cell, 3, origin, {0, 0, -1}, 0).found;
    };
    const Vec3 far_x{4.2, 0.3, 1}, far_y{0.2, -3.7, 1};
    EXPECT_FALSE(found({false, false, 0, 0, 2, 2}, far_x));
    EXPECT_TRUE(found({true, false, 0, 0, 2, 2}, far_x));
    EXPECT_FALSE(found({false, true, 0, 0, 2, 2}, far_x));
    EXPECT_TRUE(found({false, true, 0, 0, 2, 2}, far_y));
    EXPECT_TRUE(found({true, true, 0, 0, 2, 2}, {far_x.x, far_y.y, 1}));
}

TEST(FirstHitAmongCopies, KnowsWhenABorderIsHit) {
    const auto at = [](double x) {
        return first_hit_among_copies({floor_triangle}, Cell{}, 0, {x, 0.5, 1}, {0, 0, -1}, 0);
    };
    EXPECT_TRUE(at(0.5 + 1e-8).is_close_call);
    EXPECT_TRUE(at(0.5 - 1e-8).is_close_call);
    EXPECT_FALSE(at(0.49).is_close_call);
    EXPECT_FALSE(at(0.51).is_close_call);
    EXPECT_FALSE(at(0.51).found);
}

TEST(IsCloseCall, KnowsBordersEndsAndTies) {
    const LocalMesh mesh = make_local_mesh(
        {{Vec3{-1, -1, 0}, Vec3{1, -1, 0}, Vec3{-1, 1, 0}},
         {Vec3{-1, -1, 1}, Vec3{1, -1, 1}, Vec3{-1, 1, 1}}});
    const auto down = [&](double x, double y, double far) {
        return is_close_call(
            mesh, {mesh.to_local({x, y, 2}), {0, 0, -1}, 0, static_cast<float>(far * mesh.scale)});
    };
    EXPECT_FALSE(down(-0.5, -0.5, 10));
    EXPECT_TRUE(down(1e-8, 0, 10));
    EXPECT_FALSE(down(0.5, 0.5, 10));
    EXPECT_TRUE(down(-0.5, -0.5, 1));
    EXPECT_FALSE(down(-0.5, -0.5, 0.9));
    EXPECT_FALSE(down(-0.5, -0.5, 1.1));
    LocalMesh twins = mesh;
    std::vector<float> numbers(mesh.vertices.begin(), mesh.vertices.end());
    for (int corner = 0; corner < 3; ++corner) {
        const auto z = static_cast<std::size_t>(3 * corner + 2);
        numbers[z] = numbers[9 + z];
    }
    twins.vertices = numbers;
    EXPECT_TRUE(is_close_call(twins, {mesh.to_local({-0.5, -0.5, 2}), {0, 0, -1}}));
}

TEST(RandomPointOn, LiesInTheTriangle) {
    Random random(1);
    const LocalMesh mesh = make_local_mesh({floor_triangle});
    for (int i = 0; i < 1000; ++i) {
        const Vec3 p = mesh.origin + random_point_on(mesh, 0, random) / mesh.scale;
        EXPECT_TRUE(p.x >= 0 && p.y >= 0 && p.x + p.y <= 1 && p.z == 0);
    }
}

}  // namespace

}  // namespace quasimc::test

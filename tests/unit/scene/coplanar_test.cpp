#include "scene/overlap/coplanar.h"

#include <gtest/gtest.h>

#include "small_scenes.h"

namespace quasimc::test {
namespace {

TEST(Coplanar, MeasuresTheCoveredPart) {
    const Triangle whole = flat_triangle({0, 0, 0}, 2);
    EXPECT_DOUBLE_EQ(covered_part(whole, whole), 1);
    EXPECT_DOUBLE_EQ(covered_part(flat_triangle({0.25, 0.25, 0}, 1), whole), 1);
    EXPECT_DOUBLE_EQ(covered_part(whole, flat_triangle({0.25, 0.25, 0}, 1)), 0.25);
    EXPECT_DOUBLE_EQ(covered_part(flat_triangle({1, 0, 0}, 2), whole), 0.25);
    EXPECT_DOUBLE_EQ(covered_part(flat_triangle({2, 0, 0}, 2), whole), 0);
    EXPECT_DOUBLE_EQ(covered_part(flat_triangle({5, 5, 0}, 2), whole), 0);
}

TEST(Coplanar, MeasuresTheCoveredPartWhicheverSideIsUp) {
    const Triangle up = flat_triangle({0, 0, 0}, 2);
    const Triangle down{up[0], up[2], up[1]};
    EXPECT_DOUBLE_EQ(covered_part(up, down), 1);
    EXPECT_DOUBLE_EQ(covered_part(down, flat_triangle({1, 0, 0}, 2)), 0.25);
}

TEST(Coplanar, MeasuresACrossOfTwoTriangles) {
    const Triangle a{Vec3{0, 0, 0}, {3, 0, 0}, {1.5, 3, 0}};
    const Triangle b{Vec3{0, 2, 0}, {1.5, -1, 0}, {3, 2, 0}};
    EXPECT_NEAR(covered_part(a, b), 2.0 / 3, 1e-15);  // a hexagon
}

TEST(Coplanar, FindsNoAreaBetweenNeighboursInAMesh) {
    const Triangle a{Vec3{0.1, 0.2, 0.3}, {1.1, 0.3, 0.7}, {0.2, 1.7, 0.1}};
    const Triangle b{a[2], a[1], a[1] + a[2] - a[0]};
    EXPECT_LT(covered_part(a, b), 1e-15);
}

TEST(Coplanar, SeesThatNeighboursLieApart) {
    const Triangle a{Vec3{0.1, 0.2, 0.3}, {1.1, 0.3, 0.7}, {0.2, 1.7, 0.1}};
    const Triangle b{a[2], a[1], a[1] + a[2] - a[0]};
    const Triangle upside_down{b[0], b[2], b[1]};
    EXPECT_TRUE(lie_apart(a, b, 1e-6));
    EXPECT_TRUE(lie_apart(b, a, 1e-6));
    EXPECT_TRUE(lie_apart(a, upside_down, 1e-6));
    EXPECT_TRUE(lie_apart(flat_triangle({0, 0, 0}, 2), flat_triangle({2, 0, 0}, 2), 1e-6));
    EXPECT_FALSE(lie_apart(flat_triangle({0, 0, 0}, 2), flat_triangle({1.999, 0, 0}, 2), 1e-6));
    EXPECT_FALSE(lie_apart(a, a, 1e-6));
    EXPECT_TRUE(lie_apart(flat_triangle({0, 0, 0}, 2), flat_triangle({1.999, 0, 0}, 2), 2e-3));
}

TEST(Coplanar, SeesWhetherBoxesMeet) {
    const Bounds box{{0, 0, 0}, {1, 1, 1}};
    EXPECT_TRUE(meet(box, {{1, 1, 1}, {2, 2, 2}}));
    EXPECT_TRUE(meet(box, {{0.2, 0.2, 0.2}, {0.3, 0.3, 0.3}}));
    EXPECT_FALSE(meet(box, {{0, 0, 1.1}, {1, 1, 2}}));
    EXPECT_FALSE(meet({{0, 1.1, 0}, {1, 2, 1}}, box));
    EXPECT_FALSE(meet(box, {{1.1, 0, 0}, {2, 1, 1}}));
}

TEST(Coplanar, SeesAPlaneWithinTheTolerance) {
    const Triangle plane = flat_triangle({0, 0, 0});
    EXPECT_TRUE(lies_in_plane(flat_triangle({5, 5, 0.01}), plane, 0.011));
    EXPECT_FALSE(lies_in_plane(flat_triangle({5, 5, 0.01}), plane, 0.009));
}

TEST(Coplanar, ComparesCornersInAnyOrder) {
    const Triangle a = flat_triangle({1, 2, 3});
    EXPECT_TRUE(is_same(a, {a[1], a[2], a[0]}, 0));
    EXPECT_TRUE(is_same(a, {a[1], a[0], a[2]}, 0));
    EXPECT_FALSE(is_same(a, {a[1], a[0], a[0]}, 0));
    EXPECT_FALSE(is_same(a, flat_triangle({1, 2, 3}, 1.1), 0.05));
}

TEST(Coplanar, MeasuresTheSmallestHeight) {
    EXPECT_DOUBLE_EQ(height({Vec3{0, 0, 0}, {4, 0, 0}, {1, 0, 0.5}}), 0.5);
    EXPECT_DOUBLE_EQ(height({Vec3{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}), 0);
}

}  // namespace
}  // namespace quasimc::test

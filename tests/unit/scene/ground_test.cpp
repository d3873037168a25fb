#include <limits>

#include <gtest/gtest.h>

#include "scene/scene.h"
#include "small_scenes.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

Cell cell_of(bool along_x, bool along_y) {
    Cell cell;
    cell.along_x = along_x;
    cell.along_y = along_y;
    cell.low_x = -1;
    cell.low_y = -2;
    cell.size_x = 10;
    cell.size_y = 20;
    return cell;
}

/// A leaf of x 0 to 2, y 0 to 2, at height 1, above that ground.
SceneBuilder leaf_above(GroundSpec ground, const Cell& cell = {}) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("leaf", flat_triangle({0, 0, 1}, 2)));
    builder.set_ground(std::move(ground));
    builder.set_cell(cell);
    return builder;
}

Bounds ground_bounds(const Scene& scene) {
    const Organ& ground = scene.organs().back();
    Bounds bounds;
    for (std::size_t i = 0; i < ground.triangle_count; ++i) {
        for (const Vec3& corner : data_of(scene).triangles()[ground.first_triangle + i]) {
            bounds.add(corner);
        }
    }
    return bounds;
}

void expect_ground(SceneBuilder builder, const Vec3& low, const Vec3& high) {
    const Scene scene = std::move(builder).build();
    const Bounds bounds = ground_bounds(scene);
    EXPECT_EQ(bounds.low, low);
    EXPECT_EQ(bounds.high, high);
    EXPECT_DOUBLE_EQ(scene.organs().back().area, (high.x - low.x) * (high.y - low.y));
}

TEST(Ground, IsTheLastOrganAndMarked) {
    const Scene scene = leaf_above({.material = "soil"}).build();
    ASSERT_EQ(scene.organs().size(), 2U);
    EXPECT_FALSE(scene.organs()[0].is_ground);
    EXPECT_TRUE(scene.organs()[1].is_ground);
    EXPECT_EQ(scene.organs()[1].name, "ground");
    EXPECT_EQ(scene.organs()[1].id, 2);
    EXPECT_EQ(scene.material_name(scene.regions().back()), "soil");
}

TEST(Ground, IsTwoTrianglesWithTheUpperSideUp) {
    const Scene scene = leaf_above({.material = "soil"}).build();
    ASSERT_EQ(scene.organs()[1].triangle_count, 2U);
    for (std::size_t i = 1; i < 3; ++i) {
        const Vec3 normal = area_vector(data_of(scene).triangles()[i]);
        EXPECT_GT(normal.z, 0);
        EXPECT_EQ(normal.x, 0);
        EXPECT_EQ(normal.y, 0);
    }
}

TEST(Ground, LiesUnderTheOrgansByDefault) {
    expect_ground(leaf_above({.material = "soil"}), {0, 0, 0}, {2, 2, 0});
}

TEST(Ground, LiesAtItsHeight) {
    expect_ground(leaf_above({.material = "soil", .height = -3}), {0, 0, -3}, {2, 2, -3});
}

TEST(Ground, CoversItsExtent) {
    expect_ground(
        leaf_above({.material = "soil", .extent = {{-5, -6, 7, 8}}}), {-5, -6, 0}, {7, 8, 0});
}

TEST(Ground, FillsTheCell) {
    expect_ground(leaf_above({.material = "soil"}, cell_of(true, true)), {-1, -2, 0}, {9, 18, 0});
}

TEST(Ground, FillsTheCellAlongOneAxisAndLiesUnderTheOrgansAlongTheOther) {
    expect_ground(leaf_above({.material = "soil"}, cell_of(true, false)), {-1, 0, 0}, {9, 2, 0});
    expect_ground(leaf_above({.material = "soil"}, cell_of(false, true)), {0, -2, 0}, {2, 18, 0});
}

TEST(Ground, TakesAnExtentThatFitsTheCell) {
    const GroundSpec ground{.material = "soil", .extent = {{-1, -7, 9, 7}}};
    expect_ground(leaf_above(ground, cell_of(true, false)), {-1, -7, 0}, {9, 7, 0});
}

TEST(Ground, RefusesAnExtentThatIsNotTheCells) {
    const GroundSpec ground{.material = "soil", .extent = {{0, -7, 1, 7}}};
    EXPECT_EQ(
        faults_of(leaf_above(ground, cell_of(true, false))),
        (Texts{"ground: the extent along x is from 0 to 1 (the scene is periodic along it from -1 "
               "to 9); remove the extent, or give the ground as triangles"}));
}

TEST(Ground, RefusesExtentsThatAreNone) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::array<double, 4>& extent :
         {std::array{0.0, 0.0, 0.0, 1.0}, {0, 1, 1, 0}, {nan, 0, 1, 1}, {0, 0, 1, 1e31}}) {
        EXPECT_EQ(faults_of(leaf_above({.material = "soil", .extent = extent})).size(), 1U);
    }
}

TEST(Ground, RefusesAHeightThatIsNone) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(faults_of(leaf_above({.material = "soil", .height = infinity})).size(), 1U);
}

TEST(Ground, RefusesToLieUnderOrgansThatCoverNothing) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("wall", {Vec3{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    builder.set_ground({.material = "soil"});
    EXPECT_EQ(
        faults_of(std::move(builder)), (Texts{"ground: its size along x would be 0 (it extends as "
                                              "far as the organs); give its extent"}));
}

TEST(Ground, MayLieAlone) {
    SceneBuilder builder = one_band_builder();
    builder.set_ground({.material = "soil", .extent = {{0, 0, 1, 1}}});
    expect_ground(std::move(builder), {0, 0, 0}, {1, 1, 0});
}

TEST(Ground, MustSayHowLargeItIsWhenItLiesAlone) {
    SceneBuilder builder = one_band_builder();
    builder.set_ground({.material = "soil"});
    EXPECT_EQ(faults_of(std::move(builder)).size(), 2U);  // along x and along y
}

TEST(Ground, MayBeGivenAsTriangles) {
    const Triangle slope{Vec3{0, 0, 0}, {4, 0, 1}, {0, 4, 1}};
    const Scene scene =
        leaf_above({.material = "soil", .triangles = {slope}, .name = "slope"}).build();
    EXPECT_TRUE(scene.organs().back().is_ground);
    EXPECT_EQ(scene.organs().back().name, "slope");
    EXPECT_EQ(data_of(scene).triangles().back(), slope);
    EXPECT_EQ(scene.bounds().high.x, 4);
}

TEST(Ground, OfTrianglesHasNeitherHeightNorExtent) {
    EXPECT_EQ(
        faults_of(leaf_above(
            {.material = "soil",
             .height = 1,
             .extent = {{0, 0, 1, 1}},
             .triangles = {flat_triangle({})}})),
        (Texts{
            "ground: it has an extent too (it is given as triangles); remove one of them",
            "ground: it has a height too (it is given as triangles); remove one of them"}));
}

TEST(Ground, NamesItsMaterialLikeAnOrgan) {
    const Texts faults = faults_of(leaf_above({.material = "sol", .where = "scene.toml:9"}));
    EXPECT_EQ(
        faults, (Texts{"scene.toml:9: organ 'ground': material 'sol' is not defined (organs refer "
                       "to materials by name); did you mean 'soil'?"}));
}

}  // namespace
}  // namespace quasimc::test

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "small_scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

SceneBuilder leaves_builder(double scale = 1, const Vec3& shift = {}) {
    SceneBuilder builder = one_band_builder();
    for (Triangle leaf : random_leaves(500, 1.3, 10, 1)) {
        for (Vec3& corner : leaf) {
            corner = scale * corner + shift;
        }
        builder.add_organ(one_triangle("", leaf));
    }
    return builder;
}

/// One leaf of legs 1 at height 1.
SceneBuilder one_leaf() {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("leaf", flat_triangle({0, 0, 1})));
    return builder;
}

TEST(Lint, IsSilentAboutACleanCanopy) {
    EXPECT_EQ(warnings_of(leaves_builder()), Texts{});
    SceneBuilder with_ground = leaves_builder();
    with_ground.set_ground({.material = "soil", .height = -2});
    EXPECT_EQ(warnings_of(std::move(with_ground)), Texts{});
    SceneBuilder periodic = leaves_builder();
    Cell cell;
    cell.along_x = cell.along_y = true;
    cell.size_x = cell.size_y = 10;
    periodic.set_cell(cell);
    periodic.set_ground({.material = "soil", .height = -2});
    EXPECT_EQ(warnings_of(std::move(periodic)), Texts{});
}

TEST(Lint, IsSilentAboutACleanCanopyFarFromTheOrigin) {
    EXPECT_EQ(warnings_of(leaves_builder(1, {5e6, -3e6, 1e3})), Texts{});
}

TEST(Lint, IsSilentAboutACanopyOfAnySizeInAnUnknownUnit) {
    for (const double scale : {1e-9, 1e9}) {
        SceneBuilder builder = leaves_builder(scale);
        builder.set_length_unit("voxels");
        EXPECT_EQ(warnings_of(std::move(builder)), Texts{}) << scale;
    }
}

TEST(Lint, DoubtsTheUnitOfVeryLargeAndVerySmallOrgans) {
    SceneBuilder large = leaves_builder(1e3);
    EXPECT_EQ(
        warnings_of(std::move(large)).at(0).substr(0, 34), "length_unit: the median organ is 1");
    SceneBuilder small = leaves_builder(1e-6);
    EXPECT_EQ(warnings_of(std::move(small)).size(), 1U);
    SceneBuilder millimetres = leaves_builder(1e3);
    millimetres.set_length_unit("mm");
    EXPECT_EQ(warnings_of(std::move(millimetres)), Texts{});
}

TEST(Lint, DoubtsTheUnitOfOrgansThatAreTallerThanAnyTree) {
    const auto with_leaf_at = [](double height) {
        SceneBuilder builder = leaves_builder();
        builder.add_organ(one_triangle("top", flat_triangle({5, 5, height}, 0.1)));
        return warnings_of(std::move(builder));
    };
    EXPECT_EQ(with_leaf_at(100), Texts{});
    EXPECT_EQ(with_leaf_at(1000).at(0).substr(0, 38), "length_unit: the organs are within 100");
}

TEST(Lint, NamesOrgansTooSmallForSinglePrecision) {
    SceneBuilder builder = leaves_builder();
    builder.add_organ(one_triangle("speck", flat_triangle({5, 5, 5}, 1e-5)));
    EXPECT_EQ(
        warnings_of(std::move(builder)),
        (Texts{"organ 'speck' (id 501): is 7e-07 times as large as the scene, and rounding changes "
               "its shape: do all coordinates have the same unit?"}));
    SceneBuilder fine = leaves_builder();
    fine.add_organ(one_triangle("mite", flat_triangle({5, 5, 5}, 1e-3)));
    EXPECT_EQ(warnings_of(std::move(fine)), Texts{});
}

Texts warnings_about_needle(double width) {
    SceneBuilder builder = leaves_builder();
    builder.add_organ(one_triangle(
        "needle",
        {Vec3{1.1, 2.3, 3.7}, {4.3, 5.9, 6.1}, {1.1 + .8 * width, 2.3, 3.7 - .6 * width}}));
    return warnings_of(std::move(builder));
}

TEST(Lint, NamesOrgansTooThinForSinglePrecision) {
    const Texts thin = warnings_about_needle(5e-7);
    ASSERT_EQ(thin.size(), 1U);
    EXPECT_EQ(
        thin[0].substr(0, 64), "organ 'needle' (id 501): is so thin compared with the scene that");
    EXPECT_EQ(warnings_about_needle(1e-4), Texts{});
}

TEST(Lint, NamesMaterialsThatAreBlackAndInUse) {
    SceneBuilder builder = one_leaf();
    builder.add_material(lambertian("unused", 0, 0));
    builder.add_material(lambertian("tar", 0, 0));
    OrganSpec organ = one_triangle("road", flat_triangle({0, 0, 2}));
    organ.parts[0].material = "tar";
    builder.add_organ(std::move(organ));
    EXPECT_EQ(
        warnings_of(std::move(builder)),
        (Texts{"material 'tar': is black in every band (silent if 0 is written)"}));
}

TEST(Lint, LeavesMaterialsAloneThatScatterInOneBand) {
    SceneBuilder builder({{"R"}, {"FR"}});
    SideOptics black;
    SideOptics grey;
    grey.transmittance = 0.1;
    builder.add_material({"leaf", {black, black}, {black, grey}});
    builder.add_organ(one_triangle("leaf", flat_triangle({})));
    EXPECT_EQ(warnings_of(std::move(builder)), Texts{});
}

TEST(Lint, NamesOrgansWithoutArea) {
    SceneBuilder builder = one_leaf();
    OrganSpec organ = one_triangle("line", {Vec3{0, 0, 0}, {1, 1, 1}, {3, 3, 3}});
    builder.add_organ(std::move(organ));
    OrganSpec tip = one_triangle("tip", flat_triangle({3, 0, 1}));
    tip.parts[0].triangles.push_back({Vec3{3, 0, 1}, {3, 0, 1}, {4, 0, 1}});
    builder.add_organ(std::move(tip));
    EXPECT_EQ(
        warnings_of(std::move(builder)),
        (Texts{
            "organ 'line' (id 2): has no area and receives no light",
            "organ 'tip' (id 3): 1 of its 2 triangles have no area and receive no light"}));
}

TEST(Lint, NamesOrgansBelowTheGround) {
    SceneBuilder builder = one_leaf();
    builder.add_organ(one_triangle("root", flat_triangle({0, 0, -3})));
    builder.add_organ(one_triangle("stalk", {Vec3{0, 0, -0.25}, {0.1, 0, 1}, {0, 0.1, 1.1}}));
    builder.set_ground({.material = "soil"});
    EXPECT_EQ(
        warnings_of(std::move(builder)),
        (Texts{
            "organ 'root' (id 2): is below the ground (height 0)",
            "organ 'stalk' (id 3): extends 0.25 below the ground"}));
}

TEST(Lint, LetsOrgansStandOnTheGround) {
    SceneBuilder builder = one_leaf();
    builder.add_organ(one_triangle("stalk", {Vec3{0, 0, -1e-6}, {0.1, 0, 1}, {0, 0.1, 1.1}}));
    builder.set_ground({.material = "soil"});
    EXPECT_EQ(warnings_of(std::move(builder)), Texts{});
}

TEST(Lint, LooksBelowHorizontalGroundsOnly) {
    SceneBuilder builder = one_leaf();
    builder.add_organ(one_triangle("in the valley", flat_triangle({0, 0, -3})));
    builder.set_ground(
        {.material = "soil", .triangles = {{Vec3{-9, -9, -9}, {40, -9, 0}, {-9, 40, 1}}}});
    EXPECT_EQ(warnings_of(std::move(builder)), Texts{});
}

TEST(Lint, NamesAtMostThreeOfAKind) {
    SceneBuilder builder = one_leaf();
    for (int i = 0; i < 10; ++i) {
        builder.add_organ(one_triangle("root", flat_triangle({0, 0, -1.0 - i})));
    }
    builder.set_ground({.material = "soil"});
    const Texts warnings = warnings_of(std::move(builder));
    ASSERT_EQ(warnings.size(), 4U);
    EXPECT_EQ(warnings[3], "scene: 7 more organs extend below the ground");
}

TEST(Lint, NamesAGroundSmallerThanTheCanopy) {
    SceneBuilder builder = one_leaf();
    builder.set_ground({.material = "soil", .extent = {{-5, 0, 0.75, 5}}});
    EXPECT_EQ(
        warnings_of(std::move(builder)),
        (Texts{"organ 'ground' (id 2): is smaller than the canopy, which extends 0.25 beyond it "
               "along x; light escapes beside it"}));
}

TEST(Lint, NamesAGroundSmallerThanTheCell) {
    SceneBuilder builder = one_leaf();
    Cell cell;
    cell.along_y = true;
    cell.size_y = 4;
    builder.set_cell(cell);
    builder.set_ground({.material = "soil", .triangles = {flat_triangle({-5, 0, 0}, 3)}});
    EXPECT_EQ(
        warnings_of(std::move(builder)),
        (Texts{
            "organ 'ground' (id 2): is smaller than the canopy, which extends 3 beyond it along x; "
            "light escapes beside it",
            "organ 'ground' (id 2): covers 3 of the cell's 4 along y; light escapes beside it"}));
}

/// A leaf whose images do not lie in one plane.
SceneBuilder one_slope() {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("leaf", {Vec3{0, 0, 1}, {1, 0, 1.3}, {0, 1, 1}}));
    return builder;
}

TEST(Lint, NamesOrgansManyTimesWiderThanTheCell) {
    SceneBuilder builder = one_slope();
    Cell cell;
    cell.along_x = true;
    cell.size_x = 0.25;
    builder.set_cell(cell);
    EXPECT_EQ(
        warnings_of(std::move(builder)), (Texts{"organ 'leaf' (id 1): is 1 long along x, the cell "
                                                "0.25: it overlaps its periodic copies"}));
}

TEST(Lint, LetsOrgansReachOverTheCell) {
    SceneBuilder builder = one_slope();
    Cell cell;
    cell.along_x = true;
    cell.low_x = 70;
    cell.size_x = 0.5;
    builder.set_cell(cell);
    EXPECT_EQ(warnings_of(std::move(builder)), Texts{});
}

}  // namespace
}  // namespace quasimc::test

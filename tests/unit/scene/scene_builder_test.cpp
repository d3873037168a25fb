#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "scene/scene.h"
#include "small_scenes.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

TEST(SceneBuilder, KeepsOrgansInTheOrderTheyWereAdded) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("b", flat_triangle({0, 0, 1})));
    builder.add_organ(one_triangle("a", flat_triangle({0, 0, 2})));
    const Scene scene = std::move(builder).build();
    ASSERT_EQ(scene.organs().size(), 2U);
    EXPECT_EQ(scene.organs()[0].name, "b");
    EXPECT_EQ(scene.organs()[1].name, "a");
    EXPECT_EQ(data_of(scene).triangles()[0], flat_triangle({0, 0, 1}));
    EXPECT_EQ(data_of(scene).triangles()[1], flat_triangle({0, 0, 2}));
}

TEST(SceneBuilder, NumbersOrgansFromOne) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("", flat_triangle({0, 0, 1})));
    builder.add_organ(one_triangle("leaf", flat_triangle({0, 0, 2})));
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(scene.organs()[0].id, 1);
    EXPECT_EQ(scene.organs()[0].name, "organ 1");
    EXPECT_EQ(scene.organs()[1].id, 2);
    EXPECT_EQ(scene.organs()[1].name, "leaf");
}

TEST(SceneBuilder, KeepsStatedIdsAndGoesOnAfterTheLargest) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(with_id(70, "a"));
    builder.add_organ(with_id(-5, "b"));
    builder.add_organ(one_triangle("", flat_triangle({0, 0, 1})));
    builder.set_ground({.material = "soil"});
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(scene.organs()[0].id, 70);
    EXPECT_EQ(scene.organs()[1].id, -5);
    EXPECT_EQ(scene.organs()[2].id, 71);
    EXPECT_EQ(scene.organs()[3].id, 72);
    EXPECT_TRUE(scene.organs()[3].is_ground);
}

TEST(SceneBuilder, KeepsLabels) {
    SceneBuilder builder = one_band_builder();
    OrganSpec organ = one_triangle("leaf", flat_triangle({}));
    organ.labels = {{"plant", "3"}, {"kind", "leaf"}, {"plant", "again"}};
    const Labels labels = organ.labels;
    builder.add_organ(std::move(organ));
    EXPECT_EQ(std::move(builder).build().organs()[0].labels, labels);
}

TEST(SceneBuilder, KeepsEqualLabelsOnce) {
    SceneBuilder builder = one_band_builder();
    for (const char* plant : {"3", "4", "3"}) {
        OrganSpec organ = one_triangle("", flat_triangle({}));
        organ.labels = {{"plant", plant}};
        builder.add_organ(std::move(organ));
    }
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(scene.organs()[1].labels, (Labels{{"plant", "4"}}));
    EXPECT_EQ(&*scene.organs()[0].labels.begin(), &*scene.organs()[2].labels.begin());
}

TEST(SceneBuilder, MayBeCopied) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("first", flat_triangle({0, 0, 1})));
    SceneBuilder copy = builder;
    copy.add_organ(one_triangle("second", flat_triangle({0, 0, 2})));
    EXPECT_EQ(std::move(builder).build().organs().size(), 1U);
    EXPECT_EQ(std::move(copy).build().organs().size(), 2U);
}

TEST(SceneBuilder, MergesPartsOfOneMaterialAndKeepsTheirTrianglesTogether) {
    const auto z = [](double height) { return flat_triangle({0, 0, height}); };
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("first", z(9)));
    OrganSpec mixed;
    mixed.parts = {
        {"soil", {z(1)}}, {"leaf", {z(2), z(3)}}, {"soil", {z(4)}}, {"leaf", {}}, {"leaf", {z(5)}}};
    builder.add_organ(std::move(mixed));
    const Scene scene = std::move(builder).build();

    const Organ& organ = scene.organs()[1];
    EXPECT_EQ(organ.first_triangle, 1U);
    EXPECT_EQ(organ.triangle_count, 5U);
    EXPECT_EQ(organ.first_region, 1U);
    ASSERT_EQ(organ.region_count, 2U);
    EXPECT_DOUBLE_EQ(organ.area, 2.5);
    EXPECT_EQ(scene.material_name(scene.regions()[1]), "soil");
    EXPECT_EQ(scene.material_name(scene.regions()[2]), "leaf");
    EXPECT_EQ(scene.material_name(scene.regions()[2]), "leaf");
    EXPECT_EQ(scene.triangle_count(), 6U);
    for (const Region& region : scene.regions()) {
        EXPECT_EQ(scene.material_names().at(region.material.value), scene.material_name(region));
    }
    EXPECT_DOUBLE_EQ(scene.regions()[1].area, 1);
    EXPECT_DOUBLE_EQ(scene.regions()[2].area, 1.5);
    EXPECT_EQ(scene.triangles_of(organ), (std::vector<Triangle>{z(1), z(4), z(2), z(3), z(5)}));
    const std::vector<Triangle> expected{z(9), z(1), z(4), z(2), z(3), z(5)};
    EXPECT_EQ(data_of(scene).triangles(), expected);
    const std::vector<RegionIndex> regions{{0}, {1}, {1}, {2}, {2}, {2}};
    EXPECT_TRUE(std::ranges::equal(*data_of(scene).triangle_regions, regions));
}

TEST(SceneBuilder, SharesNoElementBetweenOrgans) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("a", flat_triangle({0, 0, 1})));
    builder.add_organ(one_triangle("b", flat_triangle({0, 0, 2})));
    const Scene scene = std::move(builder).build();
    ASSERT_EQ(scene.regions().size(), 2U);
    EXPECT_EQ(scene.regions()[0].organ, OrganIndex{0});
    EXPECT_EQ(scene.regions()[1].organ, OrganIndex{1});
}

RC_GTEST_PROP(SceneBuilder, GivesEveryTriangleOneElementOfItsOrgan, ()) {
    SceneBuilder builder = one_band_builder();
    const auto organs = *rc::gen::inRange<std::size_t>(1, 6);
    std::size_t triangles = 0;
    double height = 0;  // none coincide
    const auto at_own_height = [&] { return flat_triangle({0, 0, height += 1}); };
    for (std::size_t i = 0; i < organs; ++i) {
        OrganSpec organ = one_triangle("", at_own_height());
        ++triangles;
        for (auto parts = *rc::gen::inRange(0, 5); parts > 0; --parts) {
            const auto count = *rc::gen::inRange<std::size_t>(0, 3);
            triangles += count;
            std::vector<Triangle> more(count);
            std::generate(more.begin(), more.end(), at_own_height);
            const std::string material = *rc::gen::element<std::string>("leaf", "soil");
            organ.parts.push_back({material, more});
        }
        builder.add_organ(std::move(organ));
    }
    const Scene scene = std::move(builder).build();

    RC_ASSERT(scene.triangle_count() == triangles);
    RC_ASSERT(data_of(scene).triangle_regions->size() == triangles);
    std::size_t next_triangle = 0;
    std::size_t next_element = 0;
    for (std::size_t o = 0; o < organs; ++o) {
        const Organ& organ = scene.organs()[o];
        RC_ASSERT(organ.first_triangle == next_triangle);
        RC_ASSERT(organ.first_region == next_element);
        next_triangle += organ.triangle_count;
        next_element += organ.region_count;
        for (std::size_t t = organ.first_triangle; t < next_triangle; ++t) {
            const RegionIndex e = (*data_of(scene).triangle_regions)[t];
            RC_ASSERT(e.value >= organ.first_region && e.value < next_element);
            RC_ASSERT(scene.regions()[e.value].organ.value == o);
        }
    }
    RC_ASSERT(next_triangle == triangles);
    RC_ASSERT(next_element == scene.regions().size());
}

TEST(SceneBuilder, TakesMaterialsBeforeAndAfterOrgans) {
    SceneBuilder builder({{"PAR"}});
    OrganSpec organ = one_triangle("a", flat_triangle({}));
    organ.parts[0].material = "bark";
    builder.add_organ(std::move(organ));
    builder.add_material(lambertian("bark", 0.3, 0));
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(scene.material_name(scene.regions()[0]), "bark");
    EXPECT_DOUBLE_EQ(data_of(scene).materials[0].side(SurfaceSide::upper).albedo()[0], 0.3);
}

TEST(SceneBuilder, TurnsYUpIntoZUp) {
    SceneBuilder builder = one_band_builder(Orientation(UpAxis::y, {0, 0, -1}));
    // Horizontal where y is up, its upper side up.
    builder.add_organ(one_triangle("a", {Vec3{1, 5, 2}, {1, 5, 4}, {4, 5, 2}}));
    builder.set_ground({.material = "soil"});
    const Scene scene = std::move(builder).build();
    const Vec3 normal = area_vector(data_of(scene).triangles()[0]);
    EXPECT_EQ(normal, (Vec3{0, 0, 6}));
    EXPECT_EQ(data_of(scene).triangles()[0][0], (Vec3{2, 1, 5}));
    EXPECT_EQ(scene.bounds().low, (Vec3{2, 1, 0}));
    EXPECT_EQ(scene.bounds().high, (Vec3{4, 4, 5}));
    EXPECT_EQ(scene.orientation().up(), UpAxis::y);
    EXPECT_GT(area_vector(data_of(scene).triangles()[1]).z, 0);
}

TEST(SceneBuilder, TurnsAGroundOfTrianglesToo) {
    SceneBuilder builder = one_band_builder(Orientation(UpAxis::y, {0, 0, -1}));
    builder.add_organ(one_triangle("a", {Vec3{1, 5, 2}, {1, 5, 4}, {4, 5, 2}}));
    builder.set_ground({.material = "soil", .triangles = {{Vec3{0, 1, 0}, {0, 1, 9}, {9, 1, 0}}}});
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(area_vector(data_of(scene).triangles()[1]), (Vec3{0, 0, 81}));
}

TEST(SceneBuilder, KeepsWhatTheSceneIsMeasuredIn) {
    SceneBuilder builder = one_band_builder();
    builder.set_length_unit("cm");
    Cell cell;
    cell.along_y = true;
    cell.low_y = -1;
    cell.size_y = 3;
    builder.set_cell(cell);
    builder.add_organ(one_triangle("a", flat_triangle({})));
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(scene.length_unit(), "cm");
    EXPECT_EQ(scene.bands(), (std::vector<Band>{{"PAR", "W m-2"}}));
    EXPECT_TRUE(scene.cell().along_y);
    EXPECT_FALSE(scene.cell().along_x);
    EXPECT_EQ(scene.cell().size_y, 3);
}

TEST(SceneBuilder, AllowsAnOrganOfNoArea) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("line", {Vec3{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(std::move(builder).build().organs()[0].area, 0);
}

TEST(SceneBuilder, MeasuresTheSameShapesAtAnySizeAndPosition) {
    for (const double scale : {1e-25, 1e-3, 1.0, 1e6, 1e25}) {
        SceneBuilder builder = one_band_builder();
        builder.add_organ(one_triangle("a", flat_triangle({scale, -scale, 0}, scale)));
        const Scene scene = std::move(builder).build();
        EXPECT_NEAR(scene.organs()[0].area / (scale * scale), 0.5, 1e-12) << scale;
    }
}

}  // namespace
}  // namespace quasimc::test

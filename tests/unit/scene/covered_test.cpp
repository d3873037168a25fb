// What of coincident triangles is left in a scene.

#include "scene/overlap/covered.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/overlap/coplanar.h"
#include "scene/scene.h"
#include "small_scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr Triangle kSlope{Vec3{0.3, 0.1, 0.2}, {1.4, 0.2, 0.7}, {0.5, 1.3, 0.4}};

/// A point in the plane of kSlope, (0, 0), (1, 0) and (0, 1) its corners.
Vec3 on_slope(double u, double v) {
    return kSlope[0] + u * (kSlope[1] - kSlope[0]) + v * (kSlope[2] - kSlope[0]);
}

double left_over(const Triangle& t, const std::vector<Triangle>& windows) {
    return area(parts_beside(t, windows, 1e-9)) / area(t);
}

TEST(PartsBeside, HaveTheAreaThatIsNotCovered) {
    const Triangle half{on_slope(0, 0), on_slope(.5, 0), on_slope(0, 1)};
    EXPECT_NEAR(left_over(kSlope, {half}), .5, 1e-12);
    const Triangle turned{half[0], half[2], half[1]};
    EXPECT_NEAR(left_over(kSlope, {turned}), .5, 1e-12);
    const Triangle corner{on_slope(.5, 0), on_slope(1, 0), on_slope(.5, .5)};
    EXPECT_NEAR(left_over(kSlope, {half, corner}), .25, 1e-12);
    // What two windows share counts once.
    EXPECT_NEAR(left_over(kSlope, {half, half, corner, turned}), .25, 1e-12);
    const Triangle inner{on_slope(.2, .2), on_slope(.4, .2), on_slope(.2, .4)};
    EXPECT_NEAR(left_over(kSlope, {inner}), 1 - .04, 1e-12);
    const Triangle wide{on_slope(-2, -2), on_slope(5, -2), on_slope(-2, 5)};
    EXPECT_NEAR(left_over(kSlope, {wide}), 0, 1e-12);
    const Triangle beside{on_slope(1, 0), on_slope(2, 0), on_slope(1, 1)};
    EXPECT_NEAR(left_over(kSlope, {beside}), 1, 1e-12);
}

TEST(PartsBeside, KeepTheUpperSide) {
    const Triangle inner{on_slope(.2, .2), on_slope(.2, .4), on_slope(.4, .2)};
    for (const Triangle& part : parts_beside(kSlope, {inner}, 1e-9)) {
        EXPECT_GT(dot(normalized(area_vector(part)), normalized(area_vector(kSlope))), 1 - 1e-9);
    }
}

TEST(CutCovered, LeavesTheFirstWholeAndCutsTheOthers) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("first", kSlope));
    builder.add_organ(one_triangle("same", kSlope));
    builder.add_organ(one_triangle("part", {on_slope(.5, 0), on_slope(1.5, 0), on_slope(.5, 1)}));
    const Scene scene = std::move(builder).build();
    const double whole = area(kSlope);
    EXPECT_EQ(scene.triangles_of(scene.organs()[0]), std::vector<Triangle>{kSlope});
    EXPECT_EQ(scene.organs()[0].covered_area, 0);
    EXPECT_NEAR(scene.organs()[1].covered_area, whole, 1e-12);
    EXPECT_EQ(area(scene.triangles_of(scene.organs()[1])), 0);
    EXPECT_NEAR(scene.organs()[2].covered_area, .25 * whole, 1e-9);
    EXPECT_NEAR(area(scene.triangles_of(scene.organs()[2])), .75 * whole, 1e-9);
    EXPECT_NEAR(scene.organs()[2].area, whole, 1e-12);
    for (const Organ& organ : scene.organs()) {
        for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
            const Region& region =
                scene.regions()[data_of(scene).region_of(organ.first_triangle + i).value];
            EXPECT_EQ(&scene.organs()[region.organ.value], &organ);
        }
    }
}

TEST(CutCovered, ChangesNothingWhereNothingCoincides) {
    SceneBuilder builder = one_band_builder();
    const std::vector<Triangle> leaves = random_leaves(100, 1.3, 10, 7);
    for (const Triangle& leaf : leaves) {
        builder.add_organ(one_triangle("", leaf));
    }
    const Scene scene = std::move(builder).build();
    EXPECT_TRUE(data_of(scene).triangles() == leaves);
    EXPECT_TRUE(data_of(scene).coincidences->pairs.empty());
}

TEST(CutCovered, TakesCopiesOfAMeshApartOnlyWhereTheyAreCovered) {
    SceneBuilder builder = one_band_builder();
    const auto shared = std::make_shared<const Mesh>(random_leaves(70, .3, 1, 9));
    for (int i = 0; i < 10; ++i) {
        OrganSpec copy;
        copy.name = "copy";
        copy.parts.push_back({.material = "leaf", .shared = shared});
        // The last has the position of the first.
        copy.parts[0].transform.shift = {3.0 * (i % 9), 0, 0};
        builder.add_organ(copy);
    }
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(data_of(scene).triangles().instances().size(), 9U);
    EXPECT_NEAR(scene.organs()[9].covered_area, area(*shared), 1e-9);
    EXPECT_EQ(scene.organs()[0].covered_area, 0);
    EXPECT_EQ(scene.organs()[0].triangle_count, 70U);
    ASSERT_EQ(data_of(scene).coincidences->pairs.size(), 1U);
    EXPECT_EQ(data_of(scene).coincidences->pairs[0].triangles, 70U);
    for (std::size_t o = 0; o < 9; ++o) {
        const Organ& organ = scene.organs()[o];
        const Region& region =
            scene.regions()[data_of(scene).region_of(organ.first_triangle).value];
        EXPECT_EQ(region.organ.value, o);
        EXPECT_NEAR(area(scene.triangles_of(organ)), area(*shared), 1e-9);
    }
}

TEST(CutCovered, LooksThroughTheBordersOfTheCell) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("left", {Vec3{0, .2, .5}, {.3, .2, .5}, {0, .6, .5}}));
    builder.add_organ(one_triangle("right", {Vec3{2, .2, .5}, {2.3, .2, .5}, {2, .6, .5}}));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 2, .size_y = 1});
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(scene.organs()[0].covered_area, 0);
    EXPECT_NEAR(scene.organs()[1].covered_area, .06, 1e-9);
}

}  // namespace
}  // namespace quasimc::test

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "small_scenes.h"

namespace quasimc::test {
namespace {

/// An opaque organ, and sensors at heights of x = y = 0.
SceneBuilder hiding(const std::vector<Triangle>& body, std::vector<double> heights) {
    SceneBuilder builder = one_band_builder();
    builder.add_material(lambertian("wood", .2, 0));
    builder.add_organ(one_triangle("leaf", flat_triangle({3, 3, 1})));
    OrganSpec post;
    post.name = "post";
    post.parts = {{.material = "wood", .triangles = body}};
    builder.add_organ(post);
    SensorSet set{.name = "mast"};
    for (const double height : heights) {
        set.points.push_back({.position = {0.01, 0.02, height}});
    }
    builder.add_sensors(set);
    return builder;
}

const std::vector<Triangle> kBall = make_sphere({0, 0, 1}, .5, 3);

TEST(LintSensors, NamesThoseInsideClosedOrgans) {
    const auto found = warnings_of(hiding(kBall, {.2, .9, 1.3, 2}));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(
        found[0],
        "sensors 'mast': 2 of 4 points are inside a closed organ (first: 'mast 2' in organ 'post' "
        "(id 2)), which light from outside does not reach; move them");
    const auto capped = make_cylinder({0, 0, 0}, {0, 0, 2}, .5, .4, 12, true);
    const auto one = warnings_of(hiding(capped, {1}));
    ASSERT_EQ(one.size(), 1U);
    EXPECT_NE(one[0].find("1 of 1 points is inside"), std::string::npos) << one[0];
}

TEST(LintSensors, AreSilentOutsideAndInOpenOrgans) {
    EXPECT_EQ(warnings_of(hiding(kBall, {.2, 2})), std::vector<std::string>{});
    std::vector<Triangle> with_hole = kBall;
    with_hole.pop_back();
    EXPECT_EQ(warnings_of(hiding(with_hole, {1})), std::vector<std::string>{});
    const auto tube = make_cylinder({0, 0, -9}, {0, 0, 20}, .5, .5, 12, false);
    EXPECT_EQ(warnings_of(hiding(tube, {1})), std::vector<std::string>{});
}

/// A ball in a ball, whose walls face the hollow: a point in it is outside the body.
TEST(LintSensors, AreSilentInAHollowBody) {
    std::vector<Triangle> shell = make_sphere({0, 0, 1}, 1, 3);
    for (const Triangle& t : kBall) {
        shell.push_back({t[0], t[2], t[1]});
    }
    EXPECT_EQ(warnings_of(hiding(shell, {1})), std::vector<std::string>{});
    EXPECT_EQ(warnings_of(hiding(shell, {1.7})).size(), 1U) << "in the wall";
}

TEST(LintSensors, AreSilentBehindGlass) {
    SceneBuilder builder = one_band_builder();
    OrganSpec bulb;
    bulb.name = "bulb";
    bulb.parts = {{.material = "leaf", .triangles = kBall}};
    builder.add_organ(bulb);
    builder.add_sensors({.name = "s", .points = {{.position = {0, 0, 1}}}});
    EXPECT_EQ(warnings_of(std::move(builder)), std::vector<std::string>{});
}

/// In a periodic scene a point is inside the images of an organ too.
TEST(LintSensors, SeeImagesOfOrgans) {
    SceneBuilder builder = hiding(kBall, {1});
    builder.add_sensors({.name = "far", .points = {{.position = {5, -5, 1}}}});
    Cell cell;
    cell.along_x = cell.along_y = true;
    cell.size_x = cell.size_y = 5;
    builder.set_cell(cell);
    builder.set_ground({.material = "soil", .height = 0});
    EXPECT_EQ(warnings_of(std::move(builder)).size(), 2U);
}

}  // namespace
}  // namespace quasimc::test

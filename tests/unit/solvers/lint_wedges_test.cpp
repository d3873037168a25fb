#include "planner/lint_wedges.h"

#include <cmath>

#include <gtest/gtest.h>

#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// A floor and a leaf that rises from its middle at an angle of that tangent.
Scene floor_and_leaf(double slope) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .3));
    builder.add_organ(organ("floor", "leaf", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(
        organ("leaf", "leaf", {{Vec3{.5, .4, 0}, Vec3{.9, .5, .4 * slope}, Vec3{.5, .6, 0}}}));
    return std::move(builder).build();
}

std::size_t warnings_of(double slope, const Vec3& position) {
    LampSpec bulb;
    bulb.name = "bulb";
    bulb.position = position;
    bulb.flux = {1};
    return lint_wedges(floor_and_leaf(slope), {make_lamp(std::move(bulb))}).size();
}

TEST(LintWedges, TellsOfLampsNextToWhereSurfacesTouchAtASmallAngle) {
    EXPECT_EQ(warnings_of(.006, {.5, .5, 3e-5}), 1U);
    EXPECT_EQ(warnings_of(.006, {.5, .5, -3e-5}), 1U);
    EXPECT_EQ(warnings_of(.006, {.5, .401, 3e-5}), 1U) << "on the edge, away from corners";
}

TEST(LintWedges, IsSilentElsewhere) {
    EXPECT_EQ(warnings_of(.006, {.5, .5, 3e-4}), 0U) << "farther away";
    EXPECT_EQ(warnings_of(.006, {.3, .5, 3e-5}), 0U) << "where the floor is alone";
    EXPECT_EQ(warnings_of(1, {.5, .5, 3e-5}), 0U) << "half a right angle";
    EXPECT_EQ(warnings_of(0, {.5, .5, 3e-5}), 0U) << "in one plane: the leaf is cut out";
    EXPECT_TRUE(lint_wedges(floor_and_leaf(.006), {sun(0, {1})}).empty());
}

/// Of a leaf of two triangles each has the other's edge.
TEST(LintWedges, IsSilentOfLeavesThatAreBent) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .3));
    builder.add_organ(organ(
        "leaf", "leaf",
        {{Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{-1, 0, .01}},
         {Vec3{0, 0, 0}, Vec3{1, 0, .01}, Vec3{0, 1, 0}}}));
    LampSpec bulb;
    bulb.position = {0, .5, 3e-5};
    bulb.flux = {1};
    EXPECT_TRUE(lint_wedges(std::move(builder).build(), {make_lamp(std::move(bulb))}).empty());
}

}  // namespace
}  // namespace quasimc::test

// Lamps against view factors, in both directions of tracing.

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "geometry/shapes/shapes.h"
#include "quasimc/source.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

using std::numbers::pi;

/// A lamp above the origin that aims down.
std::shared_ptr<const Source> lamp_above(
    double height, const Opening& opening, const Pattern& pattern, double flux) {
    LampSpec spec;
    spec.name = "lamp";
    spec.position = {0, 0, height};
    spec.opening = opening;
    spec.pattern = pattern;
    spec.flux = {flux};
    return make_lamp(std::move(spec));
}

Scene make_floor(std::vector<Triangle> triangles) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("floor", "black", std::move(triangles)));
    return std::move(builder).build();
}

std::string at_distance(double d) {
    return fmt::format("small patch {} from a point lamp", d);
}

class Lamps : public BothWays {};

TEST_P(Lamps, ADiskSendsItsViewFactorToACoaxialDisk) {
    const Scene scene = make_floor(make_disk({0, 0, 0}, {0, 0, 1}, .5, 512));
    const Opening opening{.kind = Opening::Kind::disk, .radius = .2};
    const auto lamp = lamp_above(.5, opening, cosine_pattern(), pi * .04);
    EXPECT_TRUE(holds(
        {"disk lamp r .2 of exitance 1 over disk r .5, gap .5", .0768051, 3e-4, 1},
        trace(scene, {lamp}, 1 << 15).at(0, Quantity::absorbed_flux_density, 0)));
}

/// Two facing rectangles: the view factor of the closed form, 0.508989 (Howell, C-11).
TEST_P(Lamps, ARectangleSendsItsViewFactorToOneThatFacesIt) {
    const Scene scene = make_floor(floor_of(-1, 1, -.5, .5, 0));
    const Opening opening{.kind = Opening::Kind::rectangle, .length = 2, .width = 1};
    const auto lamp = lamp_above(.5, opening, cosine_pattern(), 2);
    EXPECT_TRUE(holds(
        {"1x2 rectangle lamp of exitance 1 over a rectangle, gap .5", .508989, 1e-3, 1},
        trace(scene, {lamp}, 1 << 15).at(0, Quantity::absorbed_flux_density, 0)));
}

/// The solid angle of a disk on the axis of a point: flux / 2 (1 - h / sqrt(h^2 + r^2)).
TEST_P(Lamps, APointSendsTheShareOfTheSolidAngle) {
    const Scene scene = make_floor(make_disk({0, 0, 0}, {0, 0, 1}, 1, 512));
    for (const double height : {.2, 3.0}) {
        const auto lamp = lamp_above(height, {}, isotropic_pattern(), 1);
        const double expected = .5 * (1 - height / std::hypot(height, 1)) / pi;
        EXPECT_TRUE(holds(
            {height < 1 ? "point lamp over a disk, near" : "point lamp over a disk, far", expected,
             expected * (height < 1 ? .01 : 1e-3), 2},
            trace(scene, {lamp}, 1 << 15).at(0, Quantity::absorbed_flux_density, 0)));
    }
}

/// 1 / (4 pi d^2), from one to a hundred times the distance.
TEST_P(Lamps, ASmallPatchFollowsTheInverseSquareLaw) {
    const Scene scene = make_floor(floor_of(-5e-4, 5e-4, -5e-4, 5e-4, 0));
    for (const double d : {1.0, 10.0, 100.0}) {
        const auto lamp = lamp_above(d, {}, isotropic_pattern(), 4 * pi * d * d);
        EXPECT_TRUE(holds(
            {at_distance(d), 1, 2e-3, 3},
            trace(scene, {lamp}, 1 << 13).at(0, Quantity::incident_upper, 0)));
    }
}

/// A sphere in the middle of a closed box: all its light arrives, a sixth on each wall.
TEST_P(Lamps, ASphereInABoxLosesNothing) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("grey", .5, 0));
    const auto wall = [](const Vec3& corner, const Vec3& a, const Vec3& b) {
        return make_parallelogram(corner, a, b);
    };
    const double s = 2;
    builder.add_organ(organ("floor", "grey", wall({-1, -1, -1}, {s, 0, 0}, {0, s, 0})));
    builder.add_organ(organ("roof", "grey", wall({-1, -1, 1}, {0, s, 0}, {s, 0, 0})));
    builder.add_organ(organ("west", "grey", wall({-1, -1, -1}, {0, s, 0}, {0, 0, s})));
    builder.add_organ(organ("east", "grey", wall({1, -1, -1}, {0, 0, s}, {0, s, 0})));
    builder.add_organ(organ("south", "grey", wall({-1, -1, -1}, {0, 0, s}, {s, 0, 0})));
    builder.add_organ(organ("north", "grey", wall({-1, 1, -1}, {s, 0, 0}, {0, 0, s})));
    const Scene scene = std::move(builder).build();
    const Opening opening{.kind = Opening::Kind::sphere, .radius = .4};
    const auto lamp = lamp_above(0, opening, cosine_pattern(), 6);
    const Result result = trace(scene, {lamp}, 1 << 14);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_TRUE(holds(
            {"sphere lamp in a grey box", 1, 1e-2, 6}, result.at(i, Quantity::absorbed_flux, 0)));
    }
}

QUASIMC_BOTH_WAYS(Lamps);

/// A plane of lamps over a plane: however high they hang, all light arrives.
TEST(PeriodicLamps, RepeatWithTheCell) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("floor", "black", floor_of(0, 2, 0, 3, 0)));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 2, .size_y = 3});
    const Scene scene = std::move(builder).build();
    for (const double height : {.5, 20.0}) {
        const auto lamp = lamp_above(height, {}, cosine_pattern(), 6);
        const Result result = run(scene, {lamp}, spec_of(Method::light_tracing, 1 << 12));
        EXPECT_TRUE(holds(
            {"lamps that repeat over a floor", 1, 1e-2, 2},
            result.at(0, Quantity::absorbed_flux_density, 0)));
    }
    const auto lamp = lamp_above(1, {}, cosine_pattern(), 6);
    EXPECT_THROW(run(scene, {lamp}, spec_of(Method::from_organs, 1 << 12)), InputError);
}

}  // namespace
}  // namespace quasimc::test

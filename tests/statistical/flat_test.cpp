// A few flat surfaces: light that they cast on each other.

#include <cmath>
#include <numbers>

#include "geometry/shapes/shapes.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

using std::numbers::sqrt2;

/// View factor from a disk of radius r to a coaxial one of radius s at distance h
/// (Howell, A catalog of radiation configuration factors, C-41).
double coaxial_disks(double r, double s, double h) {
    const double x = 1 + (h * h + s * s) / (r * r);
    return 0.5 * (x - std::sqrt(x * x - 4 * s * s / (r * r)));
}

class FlatSurfaces : public BothWays {};

TEST_P(FlatSurfaces, ABlackPatchAbsorbsAllThatFallsOnIt) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("patch", "black", floor_of(0, 1, 0, 1, 0)));
    const Scene scene = std::move(builder).build();
    const Result result = trace(scene, {sun(0, {1000})}, 1 << 14);
    EXPECT_TRUE(
        holds({"1x1 black patch, absorbed", 1000, .1}, result.at(0, Quantity::absorbed_flux, 0)));
}

/// A floor that reflects 0.3 and a black wall along one of its edges.
Scene make_l() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("floor", .3, 0));
    builder.add_material(diffuse("wall", 0, 0));
    builder.add_organ(organ("floor", "floor", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(organ("wall", "wall", make_parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1})));
    return std::move(builder).build();
}

TEST_P(FlatSurfaces, AFloorLightsTheWallThatStandsOnIt) {
    RunSpec spec = spec_of(GetParam(), 1 << 15);
    spec.max_depth = 2;
    const Result result = run(make_l(), {sun(0, {1000})}, spec);
    EXPECT_TRUE(holds(
        {"L of two squares, floor absorbs", 700, .1, 2}, result.at(0, Quantity::absorbed_flux, 0)));
    EXPECT_TRUE(holds(
        {"L of two squares, wall absorbs", 60.013, .5, 2},
        result.at(1, Quantity::absorbed_flux, 0)));
}

TEST_P(FlatSurfaces, ARectangleHidesTheSkyByItsViewFactor) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("lower", "black", floor_of(0, 2, 0, 1, 0)));
    builder.add_organ(organ("upper", "black", floor_of(0, 2, 0, 1, .5)));
    const Scene scene = std::move(builder).build();
    const Result result = trace(scene, {sky({1})}, 1 << 15);
    EXPECT_TRUE(holds(
        {"1x2 rectangles, gap .5, lying, lower one", .491011, 2e-3, 3},
        result.at(0, Quantity::incident_upper, 0)));
    EXPECT_TRUE(holds(
        {"1x2 rectangles, gap .5, lying, top of the upper one", 1, resolution(1e-3, 1e-2), 3},
        result.at(1, Quantity::incident_upper, 0)));
    EXPECT_EQ(result.at(0, Quantity::incident_lower, 0).mean, 0);
    EXPECT_EQ(result.at(1, Quantity::incident_lower, 0).mean, 0);
}

TEST_P(FlatSurfaces, StandingRectanglesHideHalfAsMuchOfTheSkyFromEachOther) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    const auto standing = [](double y) {  // upper side towards -y
        return make_parallelogram({0, y, 0}, {2, 0, 0}, {0, 0, 1});
    };
    builder.add_organ(organ("near", "black", turned_over(standing(0))));
    builder.add_organ(organ("far", "black", standing(.5)));
    const Scene scene = std::move(builder).build();
    const Result result = trace(scene, {sky({1})}, 1 << 15);
    for (const std::size_t i : {0U, 1U}) {
        EXPECT_TRUE(holds(
            {i == 0 ? "1x2 rectangles, gap .5, standing, near one"
                    : "1x2 rectangles, gap .5, standing, far one",
             .491011 / 2, resolution(1e-3, 5e-3), 4},
            result.at(i, Quantity::incident_upper, 0)));
        EXPECT_TRUE(holds(
            {i == 0 ? "1x2 rectangles, gap .5, standing, back of the near one"
                    : "1x2 rectangles, gap .5, standing, back of the far one",
             .5, resolution(1e-3, 1e-2), 4},
            result.at(i, Quantity::incident_lower, 0)));
    }
}

/// The sun shines past two small disks on a disk below, whose lit ring lights the underside of the
/// lower of them. Only the ring does: 0.3 (F(0.5 -> 1) - F(0.5 -> 0.5)); with the mean of the whole
/// floor, as programs that give a surface one radiosity have it, it would be
/// 0.3 * 0.75 F(0.5 -> 1) = 0.135372.
TEST_P(FlatSurfaces, ALitRingLightsTheDiskAboveItsShadow) {
    constexpr int kSides = 256;
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("floor", .3, 0));
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("floor", "floor", make_disk({0, 0, 0}, {0, 0, 1}, 1, kSides)));
    builder.add_organ(organ("small", "black", make_disk({0, 0, .75}, {0, 0, -1}, .5, kSides)));
    builder.add_organ(organ("shade", "black", make_disk({0, 0, .76}, {0, 0, 1}, .5, kSides)));
    const Scene scene = std::move(builder).build();
    const Result result = trace(scene, {sun(0, {1})}, 1 << 15);
    EXPECT_TRUE(holds(
        {"coaxial disks, floor absorbs per area", .525, 1e-3, 2},
        result.at(0, Quantity::absorbed_flux_density, 0)));
    const double ring = .3 * (coaxial_disks(.5, 1, .75) - coaxial_disks(.5, .5, .75));
    EXPECT_TRUE(holds(
        {"coaxial disks, underside of the small one", ring, 2e-3, 2},
        result.at(1, Quantity::incident_upper, 0)));
}

/// A black well of radius 0.5 and depth 0.5 shows a disk at its bottom the sky through the opening.
Scene make_well(double disk_radius) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("disk", "black", make_disk({0, 0, 0}, {0, 0, 1}, disk_radius, 32)));
    builder.add_organ(
        organ("well", "black", make_cylinder({0, 0, 0}, {0, 0, .5}, .5, .5, 256, false)));
    return std::move(builder).build();
}

TEST_P(FlatSurfaces, ADiskInAWellSeesTheSkyByItsViewFactor) {
    const Result result = trace(make_well(.1), {sky({1})}, 1 << 16);
    EXPECT_TRUE(holds(
        {"disk r .1 under a uniform disk, R .5, h .5", coaxial_disks(.1, .5, .5),
         from_sources() ? .02 : 1e-3},
        result.at(0, Quantity::incident_upper, 0)));
}

/// The irradiance is E R^2 / (R^2 + h^2). Light tracing can't compute it at a point.
TEST(Well, APointAtTheBottomSeesTheSkyAsADisk) {
    const Result result = run(make_well(1e-4), {sky({1})}, spec_of(Method::from_organs, 1 << 16));
    EXPECT_TRUE(holds(
        {"point under a uniform disk, R .5, h .5", .5, 1e-3},
        result.at(0, Quantity::incident_upper, 0)));
}

class TrianglePair : public BothWays {
  protected:
    /// A triangle of area 1, optionally with the same below it, 1e-5 away; a sun straight above.
    [[nodiscard]] Result light(double rho, double tau, bool pair) const {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", rho, tau));
        const auto at = [](double z) {
            return make_triangle({0, 0, z}, {sqrt2, 0, z}, {0, sqrt2, z});
        };
        builder.add_organ(organ("upper", "leaf", at(0)));
        if (pair) {
            builder.add_organ(organ("lower", "leaf", at(-1e-5)));
        }
        const Scene scene = std::move(builder).build();
        return trace(scene, {sun(0, {100})}, 1 << 16);
    }
};

TEST_P(TrianglePair, ATriangleAbsorbsWhatItNeitherReflectsNorTransmits) {
    const Result result = light(.06, .04, false);
    EXPECT_TRUE(
        holds({"triangle, incident", 100, .01, 2}, result.at(0, Quantity::incident_upper, 0)));
    EXPECT_TRUE(
        holds({"triangle, absorbed", 90, .01, 2}, result.at(0, Quantity::absorbed_flux, 0)));
}

TEST_P(TrianglePair, LightGoesToAndFroBetweenDarkTriangles) {
    const Result result = light(.06, .04, true);
    EXPECT_TRUE(holds(
        {"pair .06/.04, lower one, incident", 4.0145, .02, 2},
        result.at(1, Quantity::incident_upper, 0)));
    EXPECT_TRUE(holds(
        {"pair .06/.04, lower one, absorbed", 3.613, .02, 2},
        result.at(1, Quantity::absorbed_flux, 0)));
}

TEST_P(TrianglePair, LightGoesToAndFroBetweenBrightTriangles) {
    const Result result = light(.1, .2, true);
    EXPECT_TRUE(holds(
        {"pair .1/.2, upper one, far side", 2.020, .02, 4},
        result.at(0, Quantity::incident_lower, 0)));
    EXPECT_TRUE(holds(
        {"pair .1/.2, upper one, absorbed", 71.414, .02, 4},
        result.at(0, Quantity::absorbed_flux, 0)));
    EXPECT_TRUE(holds(
        {"pair .1/.2, lower one, incident", 20.202, .04, 4},
        result.at(1, Quantity::incident_upper, 0)));
    EXPECT_TRUE(holds(
        {"pair .1/.2, lower one, absorbed", 14.141, .04, 4},
        result.at(1, Quantity::absorbed_flux, 0)));
}

/// Controls: an expectation wrong by one per cent is rejected, and so is an imprecise run.
TEST(ClosedForms, RefuseAWrongExpectationAndABluntRun) {
    const auto wall = [](std::uint64_t paths) {
        return run(make_l(), {sun(0, {1000})}, spec_of(Method::light_tracing, paths))
            .at(1, Quantity::absorbed_flux, 0);
    };
    EXPECT_TRUE(agrees(measured(wall(1 << 15), kReplicates), 60.013, .5));
    EXPECT_FALSE(agrees(measured(wall(1 << 15), kReplicates), 1.01 * 60.013, .5));
    EXPECT_FALSE(agrees(measured(wall(1 << 8), kReplicates), 60.013, .5));
}

QUASIMC_BOTH_WAYS(FlatSurfaces);
QUASIMC_BOTH_WAYS(TrianglePair);

}  // namespace
}  // namespace quasimc::test

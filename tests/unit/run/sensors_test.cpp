// Sensors with a field of view, organs that are not measured, and light that is not counted.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

class Sensors : public ::testing::TestWithParam<Method> {
  protected:
    /// A sensor of a field of view, close above a wide ground that reflects one half.
    static Scene above_ground(double field_of_view_deg) {
        SceneBuilder builder = make_builder();
        builder.add_material(sensor("sensor"));
        builder.add_material(diffuse("soil", .5, 0));
        OrganSpec eye = organ("eye", "sensor", floor_of(-.5, .5, -.5, .5, .1));
        eye.field_of_view_deg = field_of_view_deg;
        builder.add_organ(eye);
        GroundSpec soil = ground("soil");
        soil.extent = {{-2, -2, 2, 2}};
        builder.set_ground(soil);
        return std::move(builder).build();
    }
    static Result run_from(Method from, const Scene& scene, const Sources& sources) {
        RunSpec spec = spec_of(from, 1U << 15U);
        return run(scene, sources, spec);
    }
    /// The estimate agrees with `expected` at the level of one test.
    static void expect_holds(const Estimate& estimate, double expected) {
        constexpr double kQuantile = 6;
        constexpr double kFixedPoint = 1e-11;
        EXPECT_NEAR(estimate.mean, expected, kQuantile * estimate.standard_error + kFixedPoint);
        EXPECT_LT(estimate.standard_error, .02 * expected);
    }
};

double sine_squared(double degrees) {
    return std::pow(std::sin(degrees * std::numbers::pi / 180), 2);
}

TEST_P(Sensors, SeeThePartOfTheSkyInTheirFieldOfView) {
    for (const double angle : {20.0, 60.0, 90.0}) {
        const Result result = run_from(GetParam(), above_ground(angle), {sky({1})});
        expect_holds(result.at(0, Quantity::incident_upper, 0), sine_squared(angle));
    }
}

/// Three sensors in the plane of a plate: each receives all light.
TEST_P(Sensors, CountAllLightThoughTheyLieOnEachOther) {
    SceneBuilder builder = make_builder();
    builder.add_material(sensor("sensor"));
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("a", "sensor", floor_of(0, 1, 0, 1, .5)));
    builder.add_organ(organ("b", "sensor", floor_of(.2, 1.2, 0, 1, .5)));
    builder.add_organ(organ("c", "sensor", floor_of(-.2, .8, 0, 1, .5)));
    builder.add_organ(organ("plate", "black", floor_of(0, 1, 0, 1, .5)));
    const Result result =
        run_from(GetParam(), std::move(builder).build(), {sun(30, {1}), sky({1})});
    const double all = 1 + std::sqrt(.75);
    expect_holds(result.at(0, Quantity::incident_upper, 0), all);
    for (const std::size_t i : {0U, 1U, 2U, 3U}) {
        expect_holds(result.at(i, Quantity::incident_upper, 0), all);
    }
}

/// Sensors that overlap their periodic copies across the borders of the cell along x, y and both.
TEST_P(Sensors, CountAllLightThoughTheyAreWiderThanTheirCell) {
    SceneBuilder builder = make_builder();
    builder.add_material(sensor("sensor"));
    builder.add_material(diffuse("black", 0, 0));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    builder.add_organ(organ("plate", "black", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(organ("x", "sensor", floor_of(.1, 2.6, .2, .7, .3)));
    builder.add_organ(organ("y", "sensor", floor_of(.1, .6, .2, 3.4, .6)));
    builder.add_organ(organ("both", "sensor", floor_of(-.5, 1.8, .2, 1.9, .9)));
    const Result result =
        run(std::move(builder).build(), {sun(30, {1}), sky({1})}, spec_of(GetParam(), 1U << 12U));
    const double all = 1 + std::sqrt(.75);
    for (const std::size_t i : {0U, 1U, 2U, 3U}) {
        expect_holds(result.at(i, Quantity::incident_upper, 0), all);
    }
}

TEST_P(Sensors, SeeThePartOfTheGroundInTheirFieldOfView) {
    for (const double angle : {20.0, 60.0}) {
        const Result result = run_from(GetParam(), above_ground(angle), {sun(0, {1})});
        expect_holds(result.at(0, Quantity::incident_scattered, 0), .5 * sine_squared(angle));
    }
}

TEST_P(Sensors, SeeTheSunOnlyInTheirFieldOfView) {
    const Result narrow = run_from(GetParam(), above_ground(29), {sun(30, {1})});
    EXPECT_EQ(narrow.at(0, Quantity::incident_direct, 0).mean, 0);
    const Result wide = run_from(GetParam(), above_ground(31), {sun(30, {1})});
    expect_holds(wide.at(0, Quantity::incident_direct, 0), std::cos(30 * std::numbers::pi / 180));
}

TEST_P(Sensors, OfExcludedDirectLightReceiveNothing) {
    const Scene scene = above_ground(60);
    RunSpec spec = spec_of(GetParam(), 1U << 13U);
    const Result all = run(scene, {sun(0, {1})}, spec);
    spec.direct_light = DirectLight::excluded;
    const Result scattered = run(scene, {sun(0, {1})}, spec);
    EXPECT_GT(all.at(0, Quantity::incident_upper, 0).mean, .9);
    EXPECT_EQ(scattered.at(0, Quantity::incident_upper, 0).mean, 0);
    EXPECT_EQ(
        scattered.at(0, Quantity::incident_lower, 0).mean,
        all.at(0, Quantity::incident_scattered, 0).mean);
}

/// A sensor on a leaf receives the light of that leaf, and the leaf shades as before, whichever of
/// them comes first.
TEST_P(Sensors, OnALeafLeaveItsShadeAsItIs) {
    for (const bool is_first : {true, false}) {
        SceneBuilder builder = make_builder();
        builder.add_material(sensor("sensor"));
        builder.add_material(diffuse("leaf", 0, 0));
        const OrganSpec on_leaf = organ("on leaf", "sensor", floor_of(.4, .6, .4, .6, 1));
        if (is_first) {
            builder.add_organ(on_leaf);
        }
        builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, 1)));
        if (!is_first) {
            builder.add_organ(on_leaf);
        }
        builder.add_organ(organ("below", "sensor", floor_of(.45, .55, .45, .55, 0)));
        const Result result =
            run(std::move(builder).build(), {sun(0, {1})}, spec_of(GetParam(), 1 << 12));
        const std::uint32_t on = is_first ? 0 : 1;
        EXPECT_NEAR(result.at(on, Quantity::incident_upper, 0).mean, 1, .05) << is_first;
        EXPECT_EQ(result.at(2, Quantity::incident_upper, 0).mean, 0) << is_first;
    }
}

INSTANTIATE_TEST_SUITE_P(
    BothWays, Sensors, ::testing::Values(Method::light_tracing, Method::from_organs), name_of);

TEST(SensorFaults, FieldsOfViewAreAnglesAndForSensors) {
    SceneBuilder builder = make_builder();
    builder.add_material(sensor("sensor"));
    builder.add_material(diffuse("leaf", .1, .1));
    for (const double angle : {0.0, 91.0, std::nan("")}) {
        OrganSpec eye = organ("eye", "sensor", floor_of(0, 1, 0, 1, 0));
        eye.field_of_view_deg = angle;
        builder.add_organ(eye);
    }
    OrganSpec leaf = organ("leaf", "leaf", floor_of(0, 1, 0, 1, 1));
    leaf.field_of_view_deg = 45;
    builder.add_organ(leaf);
    try {
        static_cast<void>(std::move(builder).build());
        FAIL() << "built";
    } catch (const InputError& error) {
        EXPECT_EQ(error.faults().size(), 4U) << error.what();
    }
}

/// Two leaves, side by side, the second one not measured.
Scene half_measured(bool measured) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .4, .2));
    builder.add_organ(organ("asked", "leaf", floor_of(0, 1, 0, 1, 0)));
    OrganSpec other = organ("other", "leaf", floor_of(.2, .9, 0, 1, .5));
    other.measured = measured;
    builder.add_organ(other);
    return std::move(builder).build();
}

TEST(Unmeasured, OrgansShadeAndAreNotTracedFrom) {
    const RunSpec spec = spec_of(Method::from_organs, 1U << 15U);
    const Result part = run(half_measured(false), {sky({1})}, spec);
    const Result all = run(half_measured(true), {sky({1})}, spec);
    const Estimate& asked = part.at(0, Quantity::absorbed_flux, 0);
    const Estimate& before = all.at(0, Quantity::absorbed_flux, 0);
    constexpr double kQuantile = 6;
    EXPECT_NEAR(
        asked.mean, before.mean,
        kQuantile * std::hypot(asked.standard_error, before.standard_error));
    EXPECT_LT(asked.standard_error, .01 * asked.mean);
    EXPECT_TRUE(std::isnan(part.at(1, Quantity::absorbed_flux, 0).mean));
    EXPECT_TRUE(std::isnan(part.budget[0].escaped.mean));
    EXPECT_FALSE(std::isnan(all.budget[0].escaped.mean));
}

TEST(Unmeasured, OrgansAreMeasuredAllTheSameFromSources) {
    const RunSpec spec = spec_of(Method::light_tracing, 1U << 10U);
    const Result part = run(half_measured(false), {sky({1})}, spec);
    const Result all = run(half_measured(true), {sky({1})}, spec);
    EXPECT_EQ(
        part.at(1, Quantity::absorbed_flux, 0).mean, all.at(1, Quantity::absorbed_flux, 0).mean);
}

TEST(Unmeasured, AllOrgansIsAFault) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .4, .2));
    OrganSpec leaf = organ("leaf", "leaf", floor_of(0, 1, 0, 1, 0));
    leaf.measured = false;
    builder.add_organ(leaf);
    const Scene scene = std::move(builder).build();
    EXPECT_THROW(
        static_cast<void>(run(scene, {sky({1})}, spec_of(Method::from_organs, 1024))), InputError);
}

}  // namespace
}  // namespace quasimc::test

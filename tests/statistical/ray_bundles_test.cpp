// Ray bundles: against closed forms, and against light tracing.

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "geometry/shapes/shapes.h"
#include "run/simulator.h"
#include "statistical/bundle_checks.h"
#include "statistical/canopies.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

/// Two infinite Lambertian sheets above a soil; by the adding method.
Scene two_sheets(const Cell& cell) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("sheet", .3912, .4146));
    builder.add_material(diffuse("soil", .2142, 0));
    for (const double height : {3, 2}) {
        builder.add_organ(organ(
            fmt::format("sheet at {}", height), "sheet",
            floor_of(0, cell.size_x, 0, cell.size_y, height)));
    }
    builder.set_ground(ground("soil"));
    builder.set_cell(cell);
    return std::move(builder).build();
}

void check_two_sheets(
    const std::string& words, double area, double resolution, const Result& result) {
    constexpr std::array<double, 2> kTop{1, .498772}, kBottom{.215164, .048346},
        kAbsorbed{.235985, .106250};
    constexpr unsigned kFamily = 24;
    const auto expect = [&](const std::string& what, double expected, const Estimate& e) {
        EXPECT_TRUE(holds({words + ", " + what, expected, resolution, kFamily}, e));
    };
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string sheet = fmt::format("sheet {}", i + 1);
        expect("E on top of " + sheet, kTop[i], result.at(i, Quantity::incident_upper, 0));
        expect("E below " + sheet, kBottom[i], result.at(i, Quantity::incident_lower, 0));
        expect(
            "absorbed by " + sheet, kAbsorbed[i], result.at(i, Quantity::absorbed_flux_density, 0));
    }
    expect("E on the soil", .225704, result.at(2, Quantity::incident_upper, 0));
    expect("R", .480407 * area, result.budget[0].escaped);
}

TEST(RayBundles, ShareTheLightOfInfiniteSheetsAsTheAddingMethodHasIt) {
    Cell narrow{.along_x = true, .along_y = true};
    narrow.size_y = .37;
    const Cell square{.along_x = true, .along_y = true};
    check_two_sheets(
        "sheets, sun overhead", 1, 1.5e-3,
        run(two_sheets(square), {sun(0, {1})}, bundles(1 << 15)));
    const double low = 78;
    const double facing = 1 / std::cos(low * std::acos(-1) / 180);
    check_two_sheets(
        "sheets in a narrow cell, sun at 78", .37, 5e-3,
        run(two_sheets(narrow), {sun(low, {facing})}, bundles(1 << 12)));
    check_two_sheets(
        "sheets, uniform sky", 1, 1.5e-3, run(two_sheets(square), {sky({1})}, bundles(1 << 16)));
}

/// All light of a lamp stays in a closed box: walls receive 1 / (1 - rho) of it together.
TEST(RayBundles, LoseNothingInAClosedBox) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("white", .9, 0));
    const auto wall = [](const Vec3& corner, const Vec3& a, const Vec3& b) {
        return make_parallelogram(corner, a, b);
    };
    builder.add_organ(organ("floor", "white", wall({-1, -1, -1}, {2, 0, 0}, {0, 2, 0})));
    builder.add_organ(organ("roof", "white", wall({-1, -1, 1}, {0, 2, 0}, {2, 0, 0})));
    builder.add_organ(organ("west", "white", wall({-1, -1, -1}, {0, 2, 0}, {0, 0, 2})));
    builder.add_organ(organ("east", "white", wall({1, -1, -1}, {0, 0, 2}, {0, 2, 0})));
    builder.add_organ(organ("south", "white", wall({-1, -1, -1}, {0, 0, 2}, {2, 0, 0})));
    builder.add_organ(organ("north", "white", wall({-1, 1, -1}, {2, 0, 0}, {0, 0, 2})));
    const Scene scene = std::move(builder).build();
    LampSpec lamp;
    lamp.name = "lamp";
    lamp.opening = {.kind = Opening::Kind::sphere, .radius = .4};
    lamp.pattern = cosine_pattern();
    lamp.flux = {6};
    const Result result = run(scene, {make_lamp(lamp)}, bundles(1 << 14));
    double incident = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        const Estimate& e = result.at(i, Quantity::incident_upper, 0);
        EXPECT_TRUE(holds({"white box, E on a wall", 6 / (1 - .9) / 24, .04, 6}, e));
        incident += 4 * e.mean;
    }
    EXPECT_NEAR(incident, 60, .3);
    // The orders that are not exchanged are a geometric series.
    EXPECT_EQ(result.budget[0].cut_off.mean, 0);
}

/// A floor that reflects 0.3 and a black wall along one of its edges.
Scene make_corner() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("floor", .3, 0));
    builder.add_material(diffuse("wall", 0, 0));
    builder.add_organ(organ("floor", "floor", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(organ("wall", "wall", make_parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1})));
    return std::move(builder).build();
}

TEST(RayBundles, LightTheWallThatStandsOnAFloor) {
    RunSpec spec = bundles(1 << 13);
    spec.max_depth = 2;
    const Result result = run(make_corner(), {sun(0, {1000})}, spec);
    EXPECT_TRUE(holds(
        {"L of two squares, wall absorbs", 60.013, .3, 2},
        result.at(1, Quantity::absorbed_flux, 0)));
    EXPECT_TRUE(holds(
        {"L of two squares, floor absorbs", 700, .1, 2}, result.at(0, Quantity::absorbed_flux, 0)));
}

/// Leaves that scatter most of the light, each an organ; a sensor among them, a ground below.
Scene make_stand(double reflectance = .46) {
    SceneBuilder builder = make_builder(2);
    MaterialSpec leaf = diffuse("leaf", .08, .06, 2);
    for (SideOptics* side : {&leaf.upper[1], &leaf.lower[1]}) {
        side->reflectance = reflectance;
        side->transmittance = .42;
    }
    builder.add_material(leaf);
    builder.add_material(diffuse("soil", .2, 0, 2));
    builder.add_material(sensor("sensor", 2));
    add_leaves(builder, random_leaves(30, .35, 1, 3));
    builder.add_organ(organ("sensor", "sensor", floor_of(.2, .8, .3, .7, .5)));
    GroundSpec soil = ground("soil");
    soil.extent = std::array<double, 4>{-.5, -.5, 1.5, 1.5};
    builder.set_ground(soil);
    return std::move(builder).build();
}

TEST(RayBundles, AgreeWithLightTracingOnEveryLeaf) {
    const Scene scene = make_stand();
    for (const auto& source : {sun(35, {1, 1}), sky({1, 1})}) {
        RunSpec plain = spec_of(Method::light_tracing, 1 << 14);
        plain.seed = 2;
        const Result own = run(scene, {source}, bundles(1 << 12));
        expect_same(scene, own, run(scene, {source}, plain), .03);
    }
}

TEST(RayBundles, CloseTheBudgetAndAddNoLight) {
    const Result result = run(make_stand(), {sun(35, {1, 2}), sky({1, 1})}, bundles(1 << 12));
    for (const BandBudget& budget : result.budget) {
        EXPECT_LT(budget.closure_error, 1e-12);
        // The difference between the light along lines and the exitance of surfaces has the mean 0.
        EXPECT_LT(
            std::abs(budget.imbalance.mean),
            student_t_quantile(1 - kLevel / 4, kReplicates - 1) * budget.imbalance.standard_error);
        EXPECT_LT(budget.imbalance.standard_error, 2e-3 * budget.emitted.mean);
        EXPECT_LT(budget.cut_off.mean, 1e-5 * budget.emitted.mean);
    }
}

/// An infinite stand with a lamp; its leaves extend over the borders of the cell.
TEST(RayBundles, AgreeWithLightTracingInAPeriodicStand) {
    for (const bool along_y : {true, false}) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .46, .42));
        builder.add_material(diffuse("soil", .3, 0));
        add_leaves(builder, random_leaves(20, .45, 1, 5));
        builder.set_ground(ground("soil"));
        builder.set_cell({.along_x = true, .along_y = along_y});
        const Scene scene = std::move(builder).build();
        const Sources sources{sun(60, {1}), sky({1})};
        RunSpec plain_spec = spec_of(Method::light_tracing, 1 << 13);
        plain_spec.seed = 2;
        const Result own = run(scene, sources, bundles(1 << 11));
        const Result plain = run(scene, sources, plain_spec);
        expect_same(scene, own, plain, .05);
    }
}

/// Skies that are bright in parts and dark elsewhere: sky view factors are sampled along directions
/// that such skies draw, and matter where they draw hardly any as well.
TEST(RayBundles, AgreeWithLightTracingUnderPatchySkies) {
    constexpr double kQuarter = std::numbers::pi / 2;
    const auto patchy = [](const Vec3& to_light) {
        return to_light.x > 0 && to_light.y > 0 ? 20.0 : 0.01;
    };
    const auto half = [](const Vec3& to_light) { return to_light.y > 0 ? 1.0 : 0.0; };
    const Scene scene = make_stand();
    const Sources sources{
        make_sky("patchy", {patchy, {0, kQuarter}, {}, InsideCells::constant}, {1, 1}),
        make_sky("half", {half, {0, 2 * kQuarter}, {}, InsideCells::constant}, {0, 1})};
    RunSpec plain = spec_of(Method::light_tracing, 1 << 14);
    plain.seed = 2;
    const Result own = run(scene, sources, bundles(1 << 12));
    expect_same(scene, own, run(scene, sources, plain), .05);
}

/// Two fifths of the variance came from the number of lines that meet the sky: where all
/// surroundings are about equally bright, the sky view factor of a side matters, and that is known.
TEST(RayBundles, KnowTheSkyViewFactorsOfLeaves) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .45, .45));
    builder.add_material(diffuse("soil", .5, 0));
    add_leaves(builder, random_leaves(100, .2, 1, 3));
    builder.set_ground(ground("soil"));
    builder.set_cell({.along_x = true, .along_y = true});
    const Scene scene = std::move(builder).build();
    const Sources sources{sky({1})};
    const RunSpec spec = bundles(1 << 12);
    const Result result = run(scene, sources, spec);
    double squares = 0, mean = 0;
    for (std::size_t i = 0; i < result.organs(); ++i) {
        const Estimate& e = result.at(i, Quantity::absorbed_flux_density, 0);
        squares += e.standard_error * e.standard_error;
        mean += e.mean;
    }
    const auto organs = static_cast<double>(result.organs());
    // 0.0028 if sky view factors came from lines alone.
    EXPECT_LT(std::sqrt(squares / organs), .0024 * mean / organs);
}

/// A control: leaves that scatter a little more give a significant difference.
TEST(RayBundles, AreNotTakenForThoseOfBrighterLeaves) {
    const Result own = run(make_stand(.46), {sky({1, 1})}, bundles(1 << 12));
    RunSpec other = bundles(1 << 12);
    other.seed = 2;
    const Scene brighter = make_stand(.49);
    EXPECT_LT(compare_results(brighter, own, run(brighter, {sky({1, 1})}, other)).p_value, kLevel);
}

/// A closed box whose lid leaves a slit beside a wall. Nearly all light in it falls on the upper
/// strip of that wall, of a few centimetres, and from there on the underside of the lid, at its
/// border. From the mean of patches it was up to 20 % too bright, in all replicates.
TEST(RayBundles, FindTheLightBelowANarrowSlit) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("wall", .5, 0));
    builder.add_material(diffuse("leaf", .1, .1));
    builder.add_organ(organ("lid", "wall", floor_of(0, .99, 0, 1, 1)));
    for (const auto& [name, a, b] :
         {std::tuple("west", Vec3{0, 0, 0}, Vec3{0, 1, 0}),
          std::tuple("east", Vec3{1, 0, 0}, Vec3{1, 1, 0}),
          std::tuple("south", Vec3{0, 0, 0}, Vec3{1, 0, 0}),
          std::tuple("north", Vec3{0, 1, 0}, Vec3{1, 1, 0})}) {
        const Vec3 up{0, 0, 1};
        builder.add_organ(organ(name, "wall", {{a, b, b + up}, {a, b + up, a + up}}));
    }
    builder.add_organ(organ("floor", "wall", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(
        organ("leaf", "leaf", {{Vec3{.3, .3, .4}, Vec3{.7, .3, .5}, Vec3{.5, .7, .4}}}));
    const Scene scene = std::move(builder).build();
    const Sources sources{sky({1})};
    RunSpec plain = spec_of(Method::first_hits, std::uint64_t{1} << 20U);
    plain.seed = 2;
    const Estimate truth = run(scene, sources, plain).at(0, Quantity::incident_lower, 0);
    const Estimate own = run(scene, sources, bundles(1 << 14)).at(0, Quantity::incident_lower, 0);
    ASSERT_LT(truth.standard_error, .02 * truth.mean);
    EXPECT_LT(own.standard_error, .03 * truth.mean);
    EXPECT_LT(
        std::abs(own.mean - truth.mean), 4 * std::hypot(own.standard_error, truth.standard_error));
}

/// A black leaf, a long strip of which is close above lit soil, in the view factor of the soil that
/// it does not shade (crossed strings). From the mean of patches it had up to ten times the light.
TEST(RayBundles, FindTheShadeBelowALeafOnLitSoil) {
    constexpr double kHalf = .05, kReflectance = .5;
    for (const double height : {.001, .004, .016}) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("black", 0, 0));
        builder.add_material(diffuse("soil", kReflectance, 0));
        builder.add_organ(organ("soil", "soil", floor_of(-1, 1, -.1, .1, 0)));
        builder.add_organ(organ("leaf", "black", floor_of(-kHalf, kHalf, -.1, .1, height)));
        builder.set_cell({.along_y = true, .low_y = -.1, .size_y = .2});
        const Scene scene = std::move(builder).build();
        const auto string = [&](double x, double z, double to) { return std::hypot(to - x, z); };
        const double seen = string(-kHalf, height, 1) + string(kHalf, height, kHalf) -
                            string(-kHalf, height, kHalf) - string(kHalf, height, 1);
        const double truth = kReflectance * seen / (2 * kHalf);
        std::vector<double> found;
        double reported = 0;
        RunSpec spec = bundles(1 << 12);
        for (spec.seed = 1; spec.seed <= 12; ++spec.seed) {
            const Estimate own = run(scene, {sun(0, {1})}, spec).at(1, Quantity::incident_lower, 0);
            found.push_back(own.mean);
            reported += own.standard_error / 12;
        }
        EXPECT_TRUE(agrees(measured(found), truth, .6 * truth)) << height;
        EXPECT_LT(reported, .5 * truth) << height;
    }
}

class BundleCoverage : public ::testing::TestWithParam<std::uint64_t> {};

/// The truth is that of another method.
TEST_P(BundleCoverage, NinetyFivePercentIntervalsHoldTheTruthAtLeastThatOften) {
    expect_intervals_hold(make_stand(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Long, BundleCoverage, ::testing::Values(256, 4096), [](const auto& paths) {
    return std::to_string(paths.param) + "_paths";
});

}  // namespace
}  // namespace quasimc::test

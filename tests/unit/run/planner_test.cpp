#include "planner/planner.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "quasimc/source.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

std::shared_ptr<const Source> lamp(double flux = 1) {
    LampSpec spec;
    spec.name = "lamp";
    spec.position = {.5, .5, 3};
    spec.flux = {flux};
    return make_lamp(std::move(spec));
}

/// A hundred equal leaves, some of them measured.
struct StandSpec {
    std::size_t measured = 100;
    MaterialSpec leaf = diffuse("leaf", .1, .1);
    Cell cell = {};
};

Scene make_stand(const StandSpec& spec) {
    SceneBuilder builder = make_builder();
    builder.add_material(spec.leaf);
    std::size_t count = 0;
    for (const Triangle& triangle : random_leaves(100, .1, 1, 5)) {
        OrganSpec leaf = organ("", "leaf", {triangle});
        leaf.measured = count++ < spec.measured;
        builder.add_organ(std::move(leaf));
    }
    builder.set_cell(spec.cell);
    return std::move(builder).build();
}

/// Leaves that reflect by one of the models.
MaterialSpec glossy(const std::string& model, double exponent) {
    MaterialSpec leaf = diffuse("leaf", .1, .1);
    for (SideOptics* side : {&leaf.upper[0], &leaf.lower[0]}) {
        side->reflection_model = model;
        side->reflection_parameters["exponent"] = exponent;
    }
    return leaf;
}

ChosenMethod plan(const StandSpec& stand, const Sources& sources) {
    RunSpec spec;
    spec.method = Method::automatic;
    return plan_method(make_stand(stand), sources, spec);
}

constexpr Cell kField{.along_x = true, .along_y = true};

TEST(Planner, LeavesAnExplicitChoice) {
    for (const Method from : {Method::light_tracing, Method::from_organs, Method::first_hits}) {
        const ChosenMethod choice =
            plan_method(make_stand(StandSpec{}), {sun(0, {1})}, spec_of(from, 1));
        EXPECT_EQ(choice.method, from);
        EXPECT_EQ(choice.reason, "requested");
    }
}

TEST(Planner, TakesBundlesForLambertianSurfaces) {
    EXPECT_EQ(plan({}, {sun(0, {1})}).method, Method::ray_bundles);
    EXPECT_EQ(plan({}, {sky({1})}).method, Method::ray_bundles);
    EXPECT_EQ(plan({.cell = kField}, {sun(0, {1})}).method, Method::ray_bundles);
}

TEST(Planner, TracesSunsAndSkiesFromWhatTheyLight) {
    const StandSpec shiny{.leaf = glossy("phong", 10)};
    EXPECT_EQ(plan(shiny, {sun(0, {1})}).method, Method::first_hits);
    EXPECT_EQ(plan(shiny, {sky({1})}).method, Method::first_hits);
    EXPECT_EQ(plan({}, {lamp(), sky({1})}).method, Method::first_hits) << "lamps are traced";
}

/// Lines hit each patch a few times in every iteration, however few paths there are; with very many
/// paths per organ first hits have smaller errors than patches.
TEST(Planner, TakesBundlesForNeitherTooFewPathsNorTooMany) {
    const auto planned = [](std::size_t leaves, std::uint64_t paths) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .1, .1));
        add_leaves(builder, random_leaves(leaves, .1, 1, 5));
        return plan_method(
                   std::move(builder).build(), {sky({1})}, spec_of(Method::automatic, paths))
            .method;
    };
    EXPECT_EQ(planned(10'000, 1024), Method::first_hits);
    EXPECT_EQ(planned(10'000, 4096), Method::ray_bundles);
    EXPECT_EQ(planned(20, 16'384), Method::ray_bundles);
    EXPECT_EQ(planned(20, 65'536), Method::first_hits);
    EXPECT_EQ(planned(5, 4096), Method::first_hits);
}

/// A ground so wide that its patches could not resolve a leaf's shadow.
TEST(Planner, TakesBundlesOnlyWherePatchesHoldTheShadowsOfOrgans) {
    const auto planned = [](double half_width) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .1, .1));
        add_leaves(builder, random_leaves(100, .1, 1, 5));
        GroundSpec soil = ground("leaf");
        soil.extent = std::array<double, 4>{-half_width, -half_width, half_width, half_width};
        builder.set_ground(soil);
        return plan_method(std::move(builder).build(), {sky({1})}, spec_of(Method::automatic, 512))
            .method;
    };
    EXPECT_EQ(planned(.4), Method::ray_bundles);
    EXPECT_NE(planned(.9), Method::ray_bundles);
}

/// Light between small things, on patches that lines rarely hit.
TEST(Planner, TakesBundlesOnlyWhereLinesMeetThePatchesOfAllOrgans) {
    const auto planned = [](double radius) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .1, .1));
        add_leaves(builder, random_leaves(100, .1, 1, 5));
        builder.add_organ(organ(
            "drum", "leaf", make_cylinder({.5, .5, 2}, {0, 0, radius}, radius, radius, 16, true)));
        return plan_method(std::move(builder).build(), {sky({1})}, spec_of(Method::automatic, 4096))
            .method;
    };
    EXPECT_EQ(planned(.1), Method::ray_bundles);
    EXPECT_EQ(planned(.001), Method::first_hits);
}

/// Under a sun, beside closed stems of long triangles, whose errors do not decrease with more
/// paths.
TEST(Planner, TakesFewPathsForBundlesBesideManyStems) {
    const auto planned = [](int stems, const Sources& sources, std::uint64_t paths) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .1, .1));
        add_leaves(builder, random_leaves(200, .3, 1, 5));
        for (int i = 0; i < stems; ++i) {
            const Vec3 base{.1 * i, .5, 0};
            builder.add_organ(
                organ("", "leaf", make_cylinder(base, {0, 0, 2}, .008, .008, 8, true)));
        }
        return plan_method(std::move(builder).build(), sources, spec_of(Method::automatic, paths))
            .method;
    };
    EXPECT_EQ(planned(20, {sun(0, {1})}, 512), Method::ray_bundles);
    EXPECT_EQ(planned(20, {sun(0, {1})}, 8192), Method::first_hits);
    EXPECT_EQ(planned(20, {sky({1})}, 8192), Method::ray_bundles);
    EXPECT_EQ(planned(10, {sun(0, {1})}, 8192), Method::ray_bundles);
}

/// Leaves that all cross at one point.
TEST(Planner, ARunTakesAnotherMethodWherePatchesCantBeCut) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .1));
    constexpr int kLeaves = 500;
    for (int i = 0; i < kLeaves; ++i) {
        const double angle = M_PI * i / kLeaves;
        const Vec3 along{std::cos(angle), std::sin(angle), .5 * std::sin(7 * angle)};
        const Vec3 up{.3 * std::sin(11 * angle), .2 * std::cos(5 * angle), 1};
        builder.add_organ(
            organ("", "leaf", make_parallelogram(-1 * along - .5 * up, 2 * along, up)));
    }
    const Scene scene = std::move(builder).build();
    const RunSpec spec = spec_of(Method::automatic, 1024);
    ASSERT_EQ(plan_method(scene, {sun(0, {1})}, spec).method, Method::ray_bundles);
    EXPECT_EQ(run(scene, {sun(0, {1})}, spec).chosen.method, Method::first_hits);
}

/// A sun that grazes an infinite stand is sampled by paths from the source, and its scattered light
/// too.
TEST(Planner, ARunTakesAnotherMethodWhereSunsAloneGrazeAnInfiniteStand) {
    const Scene scene = make_stand({.cell = kField});
    const RunSpec spec = spec_of(Method::automatic, 1024);
    ASSERT_EQ(plan_method(scene, {sun(89.95, {1})}, spec).method, Method::ray_bundles);
    EXPECT_EQ(run(scene, {sun(89.95, {1})}, spec).chosen.method, Method::first_hits);
    EXPECT_EQ(run(scene, {sun(20, {1})}, spec).chosen.method, Method::ray_bundles);
    EXPECT_EQ(run(scene, {sun(89.95, {1}), sky({1})}, spec).chosen.method, Method::ray_bundles);
}

TEST(Planner, TracesLampsFromThemselves) {
    const StandSpec bright{.leaf = diffuse("leaf", .4, .4)};
    EXPECT_EQ(plan(bright, {lamp()}).method, Method::light_tracing);
    // A dark source does not count.
    EXPECT_EQ(plan(bright, {lamp(), sun(0, {0})}).method, Method::light_tracing);
    EXPECT_EQ(plan({}, {lamp(0), sun(0, {1})}).method, Method::ray_bundles);
}

TEST(Planner, TracesFromTheOrgansWhereFewAreMeasured) {
    const StandSpec few{.measured = 2};
    for (const auto& source : {sun(0, {1}), sky({1}), lamp()}) {
        EXPECT_EQ(plan(few, {source}).method, Method::from_organs) << source->name();
    }
    EXPECT_EQ(plan(few, {lamp(), sun(0, {1})}).method, Method::from_organs);
    EXPECT_NE(plan(few, {sky({1})}).reason.find("50 times as efficient"), std::string::npos);
    EXPECT_EQ(plan({.measured = 60}, {sky({1})}).method, Method::ray_bundles);
}

/// Leaves in a row, so far apart that little of the entering light hits one.
TEST(Planner, TracesFromTheOrgansWhereASceneIsNearlyEmpty) {
    const auto row = [](double apart) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .2, .2));
        for (int i = 0; i < 100; ++i) {
            const double x = i * apart;
            builder.add_organ(organ("", "leaf", floor_of(x, x + .5, 0, .5, .1 * (i % 2))));
        }
        return std::move(builder).build();
    };
    RunSpec spec;
    spec.method = Method::automatic;
    EXPECT_EQ(plan_method(row(.6), {sun(0, {1})}, spec).method, Method::ray_bundles);
    EXPECT_EQ(plan_method(row(9), {sun(0, {1})}, spec).method, Method::from_organs);
    EXPECT_EQ(plan_method(row(9), {sky({1})}, spec).method, Method::from_organs);
}

TEST(Planner, NeverChoosesOrgansWhenNoneIsMeasured) {
    for (const auto& source : {sun(0, {1}), sky({1}), lamp()}) {
        EXPECT_NE(plan({.measured = 0}, {source}).method, Method::from_organs);
    }
}

TEST(Planner, KnowsThatShinyLeavesHideTheSun) {
    for (const MaterialSpec& leaf : {glossy("mirror", 0), glossy("phong", 2000)}) {
        const StandSpec shiny{.measured = 2, .leaf = leaf};
        EXPECT_EQ(plan(shiny, {sun(0, {1})}).method, Method::first_hits);
        EXPECT_EQ(plan(shiny, {sky({1})}).method, Method::from_organs);
        const StandSpec one{.measured = 1, .leaf = leaf};
        EXPECT_EQ(plan(one, {sun(0, {1})}).method, Method::first_hits);
    }
    for (const double exponent : {20.0, 60.0}) {
        const StandSpec dull{.measured = 2, .leaf = glossy("phong", exponent)};
        EXPECT_EQ(plan(dull, {sun(0, {1})}).method, Method::from_organs) << exponent;
    }
}

/// A sensor sees the sun in leaves of any lobe. Paths reach it through mirrors so rarely with every
/// method that the fastest is taken.
TEST(Planner, SamplesLobesFromSensorsButNotMirrors) {
    for (const Sources& light : {Sources{sun(0, {1})}, Sources{lamp()}}) {
        const auto planned = [&](const MaterialSpec& leaf) {
            SceneBuilder builder = make_builder();
            builder.add_material(leaf);
            builder.add_material(sensor("sensor"));
            builder.add_organ(organ("eye", "sensor", floor_of(.5, .505, .5, .505, .5)));
            for (const Triangle& triangle : random_leaves(100, .1, 1, 5)) {
                OrganSpec one = organ("", "leaf", {triangle});
                one.measured = false;
                builder.add_organ(std::move(one));
            }
            RunSpec spec;
            spec.method = Method::automatic;
            return plan_method(std::move(builder).build(), light, spec).method;
        };
        EXPECT_EQ(planned(glossy("phong", 2000)), Method::from_organs);
        EXPECT_NE(planned(glossy("mirror", 0)), Method::from_organs);
    }
}

/// Lamps at a distance from low-albedo leaves are sampled from all of them, with enough paths; not
/// lamps among the leaves, nor with high-albedo leaves, nor with a sun.
TEST(Planner, SamplesLampsAtADistanceFromLowAlbedoLeaves) {
    const auto planned = [](double height, double albedo, std::uint64_t paths) {
        LampSpec spec;
        spec.name = "lamp";
        spec.position = {.5, .5, height};
        spec.flux = {1};
        RunSpec run;
        run.method = Method::automatic;
        run.paths = paths;
        const StandSpec stand{.leaf = diffuse("leaf", albedo, albedo)};
        return plan_method(make_stand(stand), {make_lamp(spec)}, run).method;
    };
    EXPECT_EQ(planned(3, .1, 1 << 14), Method::from_organs);
    EXPECT_EQ(planned(.5, .1, 1 << 14), Method::light_tracing);
    EXPECT_EQ(planned(3, .4, 1 << 14), Method::light_tracing);
    EXPECT_EQ(planned(3, .1, 1 << 10), Method::light_tracing);
    // Above the box, whose bounding sphere would contain it; close to its top, much of which it
    // lights more brightly than the rest.
    EXPECT_EQ(planned(1.3, .1, 1 << 14), Method::from_organs);
    EXPECT_EQ(planned(1.1, .1, 1 << 14), Method::light_tracing);
}

TEST(Planner, NeverTracesRepeatedLampsFromTheOrgans) {
    const StandSpec few{.measured = 2, .cell = kField};
    EXPECT_EQ(plan(few, {lamp()}).method, Method::light_tracing);
    EXPECT_EQ(plan(few, {lamp(), sky({1})}).method, Method::first_hits);
    EXPECT_EQ(plan(few, {sky({1})}).method, Method::from_organs);
}

TEST(Planner, ComparesTheMeasuredOrgansWithAll) {
    EXPECT_NEAR(gain_of_equal_shares(make_stand(StandSpec{})), 1, 1e-12);
    EXPECT_NEAR(gain_of_equal_shares(make_stand({.measured = 4})), 25, 1e-10);
    EXPECT_EQ(
        gain_of_equal_shares(make_stand({.measured = 0})), std::numeric_limits<double>::infinity());
    // The median of areas 1, 4 and 100 is 4.
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .1));
    for (const double side : {1.0, 2.0, 10.0}) {
        builder.add_organ(organ("", "leaf", floor_of(0, side, 0, side, side)));
    }
    EXPECT_NEAR(gain_of_equal_shares(std::move(builder).build()), 105.0 / (3 * 4), 1e-12);
}

TEST(Planner, MeasuresLobesByTheirPeaks) {
    // The leaf reflects and transmits a tenth each.
    EXPECT_DOUBLE_EQ(brightest_peak(make_stand(StandSpec{})), .1);
    EXPECT_DOUBLE_EQ(brightest_peak(make_stand({.leaf = glossy("phong", 29)})), 1.5);
    for (const auto& leaf : {glossy("mirror", 0), glossy("phong", 60)}) {
        EXPECT_EQ(
            brightest_peak(make_stand({.leaf = leaf})), std::numeric_limits<double>::infinity());
    }
    EXPECT_EQ(brightest_peak(make_stand({.leaf = sensor("leaf")})), 0);
}

TEST(Planner, MakesTheRunThatItNames) {
    const Scene scene = make_stand({.measured = 2});
    for (const Sources& sources : {Sources{sun(0, {1})}, Sources{lamp()}}) {
        RunSpec spec = spec_of(Method::automatic, 1 << 8);
        const Result chosen = run(scene, sources, spec);
        EXPECT_EQ(chosen.chosen.method, plan_method(scene, sources, spec).method);
        spec.method = chosen.chosen.method;
        const Result asked = run(scene, sources, spec);
        EXPECT_EQ(asked.chosen.reason, "requested");
        EXPECT_EQ(
            chosen.at(0, Quantity::absorbed_flux, 0).mean,
            asked.at(0, Quantity::absorbed_flux, 0).mean);
        EXPECT_EQ(chosen.rays, asked.rays);
    }
}

}  // namespace
}  // namespace quasimc::test

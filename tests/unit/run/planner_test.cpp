#include "planner/planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

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

std::vector<Method> candidates(const Scene& scene, const Sources& sources) {
    return candidate_methods(
        scene, sources, spec_of(Method::automatic, 4096), [] { return false; });
}
std::vector<Method> candidates_in(const StandSpec& stand, const Sources& sources) {
    return candidates(make_stand(stand), sources);
}
bool has(const std::vector<Method>& methods, Method method) {
    return std::ranges::count(methods, method) > 0;
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

TEST(Planner, KnowsWhichMethodsCanBeUsed) {
    using enum Method;
    using Methods = std::vector<Method>;
    for (const auto& source : {sun(0, {1}), sky({1})}) {
        EXPECT_EQ(candidates_in({}, {source}), (Methods{ray_bundles, first_hits, from_organs}));
        const StandSpec shiny{.leaf = glossy("phong", 10)};
        EXPECT_EQ(candidates_in(shiny, {source}), (Methods{first_hits, from_organs}));
    }
    EXPECT_EQ(candidates_in({}, {lamp()}), (Methods{light_tracing, from_organs}));
    // A dark source does not count.
    EXPECT_EQ(candidates_in({}, {lamp(), sun(0, {0})}), (Methods{light_tracing, from_organs}));
    EXPECT_EQ(
        candidates_in({}, {lamp(0), sun(0, {1})}), (Methods{ray_bundles, first_hits, from_organs}));
    // Lamps repeat with the scene.
    EXPECT_EQ(candidates_in({.cell = kField}, {lamp()}), Methods{light_tracing});
    EXPECT_EQ(candidates_in({.measured = 0}, {lamp()}), Methods{light_tracing});
}

TEST(Planner, BeginsWithTheOrgansWhereFewAreMeasured) {
    const StandSpec few{.measured = 2};
    for (const auto& source : {sun(0, {1}), sky({1}), lamp()}) {
        EXPECT_EQ(candidates_in(few, {source}).front(), Method::from_organs);
        EXPECT_NE(candidates_in({.measured = 60}, {source}).front(), Method::from_organs);
    }
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
        return has(candidates(std::move(builder).build(), {sky({1})}), Method::ray_bundles);
    };
    EXPECT_TRUE(planned(.4));
    EXPECT_FALSE(planned(3));
}

/// Light between small things, on patches that lines rarely hit.
TEST(Planner, TakesBundlesOnlyWhereLinesMeetThePatchesOfAllOrgans) {
    const auto planned = [](double radius) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .1, .1));
        add_leaves(builder, random_leaves(100, .1, 1, 5));
        builder.add_organ(organ(
            "drum", "leaf", make_cylinder({.5, .5, 2}, {0, 0, radius}, radius, radius, 16, true)));
        return has(candidates(std::move(builder).build(), {sky({1})}), Method::ray_bundles);
    };
    EXPECT_TRUE(planned(.1));
    EXPECT_FALSE(planned(.001));
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
    ASSERT_TRUE(has(candidates(scene, {sun(0, {1})}), Method::ray_bundles));
    const RunSpec spec = spec_of(Method::automatic, 1024);
    EXPECT_EQ(run(scene, {sun(0, {1})}, spec).chosen.method, Method::first_hits);
}

/// Leaves in a row, so far apart that little of the entering light hits one.
TEST(Planner, BeginsWithTheOrgansWhereASceneIsNearlyEmpty) {
    const auto row = [](double apart) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .2, .2));
        for (int i = 0; i < 100; ++i) {
            const double x = i * apart;
            builder.add_organ(organ("", "leaf", floor_of(x, x + .5, 0, .5, .1 * (i % 2))));
        }
        return std::move(builder).build();
    };
    EXPECT_EQ(candidates(row(.6), {sun(0, {1})}).front(), Method::ray_bundles);
    EXPECT_EQ(candidates(row(9), {sun(0, {1})}).front(), Method::from_organs);
    EXPECT_EQ(candidates(row(9), {sky({1})}).front(), Method::from_organs);
}

/// Measured: bundles of bright leaves have a third of the error of first hits for equal work; one
/// leaf of a hundred is sampled best from itself.
TEST(Planner, TakesWhatIsBestInPilotRuns) {
    const StandSpec bright{.leaf = diffuse("leaf", .45, .45)};
    EXPECT_EQ(plan(bright, {sky({1})}).method, Method::ray_bundles);
    EXPECT_NE(plan(bright, {sky({1})}).reason.find("times by first_hits"), std::string::npos);
    EXPECT_EQ(plan({.measured = 1}, {sky({1})}).method, Method::from_organs);
}

TEST(Planner, KnowsWhereMirrorsHideTheSun) {
    for (const auto& source : {sun(0, {1}), lamp()}) {
        for (const MaterialSpec& leaf : {glossy("mirror", 0), glossy("phong", 2000)}) {
            EXPECT_TRUE(hides_light(make_stand({.leaf = leaf}), {source}));
        }
        EXPECT_FALSE(hides_light(make_stand({.leaf = glossy("phong", 10)}), {source}));
        EXPECT_FALSE(hides_light(make_stand({.leaf = sensor("leaf")}), {source}));
    }
    EXPECT_FALSE(hides_light(make_stand({.leaf = glossy("mirror", 0)}), {sky({1})}));
}

TEST(Planner, HasTheSameReasonOnAnyNumberOfThreads) {
    RunSpec spec;
    spec.threads = 1;
    const Scene scene = make_stand(StandSpec{});
    const std::string alone = plan_method(scene, {sky({1})}, spec).reason;
    spec.threads = 3;
    EXPECT_EQ(plan_method(scene, {sky({1})}, spec).reason, alone);
}

TEST(Planner, TriesNothingForFewPaths) {
    const ChosenMethod choice =
        plan_method(make_stand(StandSpec{}), {sky({1})}, spec_of(Method::automatic, 16));
    EXPECT_EQ(choice.method, Method::ray_bundles);
    EXPECT_EQ(choice.reason, "too few paths for pilot runs");
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

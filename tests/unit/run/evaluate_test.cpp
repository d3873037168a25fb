#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "geometry/shapes/shapes.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr std::uint64_t kPaths = 1024;

class EvaluateBothWays : public BothWays {
  protected:
    [[nodiscard]] Result trace(const Scene& scene, const Sources& sources) const {
        return BothWays::trace(scene, sources, kPaths);
    }
};

/// A grey leaf inside a black box under the sun, without light.
Scene make_dark_room() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .3, .1, 2));
    builder.add_material(diffuse("black", 0, 0, 2));
    builder.add_organ(organ("leaf", "leaf", floor_of(.4, .6, .4, .6, .5)));
    std::vector<Triangle> walls = floor_of(0, 1, 0, 1, 0);
    const auto add = [&](const std::vector<Triangle>& wall) {
        walls.insert(walls.end(), wall.begin(), wall.end());
    };
    add(floor_of(0, 1, 0, 1, 1));
    add(make_parallelogram({0, 0, 0}, {1, 0, 0}, {0, 0, 1}));
    add(make_parallelogram({0, 1, 0}, {1, 0, 0}, {0, 0, 1}));
    add(make_parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    add(make_parallelogram({1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    builder.add_organ(organ("room", "black", walls));
    return std::move(builder).build();
}

TEST_P(EvaluateBothWays, AnOrganThatNoPathHitHasAnUpperBoundAndNoError) {
    RunSpec spec = spec_of(GetParam(), kPaths);
    spec.ratios = {"b0:b1"};
    const Scene scene = make_dark_room();
    const Result result = run(scene, {sun(0, {10, 20})}, spec);
    for (const QuantityEntry& entry : quantity_table()) {
        for (const std::size_t band : {0U, 1U}) {
            const Estimate& dark = result.at(0, entry.quantity, band);
            EXPECT_EQ(dark.mean, 0) << entry.name;
            EXPECT_TRUE(std::isnan(dark.standard_error)) << entry.name;
            EXPECT_EQ(dark.ci95_low, 0);
            EXPECT_GT(dark.ci95_high, 0);
            EXPECT_LT(dark.ci95_high, .1 * result.at(1, entry.quantity, band).ci95_high + .1)
                << entry.name;
        }
    }
    EXPECT_TRUE(std::isnan(result.ratio(0, 0).mean));
    EXPECT_EQ(result.sunlit_fraction[0].mean, 0);
    EXPECT_GT(result.sunlit_fraction[0].ci95_high, 0);
}

/// A grey ground close under a larger black plate, the sun overhead: the total absorbed by the
/// ground is as unknown as its incident light.
TEST_P(EvaluateBothWays, WhatNoPathFoundHasAnUpperBoundInTheBudgetToo) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("soil", .3, 0, 2));
    builder.add_material(diffuse("black", 0, 0, 2));
    builder.add_organ(organ("plate", "black", floor_of(0, 1, 0, 1, 1)));
    GroundSpec soil = ground("soil");
    soil.height = .5;
    soil.extent = {{.4, .4, .6, .6}};
    builder.set_ground(soil);
    const Result result = trace(std::move(builder).build(), {sun(0, {10, 20})});
    for (const std::size_t band : {0U, 1U}) {
        const Estimate& whole = result.budget[band].absorbed_by_ground;
        const Estimate& own = result.at(1, Quantity::absorbed_flux, band);
        EXPECT_EQ(whole.mean, 0);
        EXPECT_TRUE(std::isnan(whole.standard_error));
        EXPECT_GT(whole.ci95_high, 0);
        EXPECT_EQ(whole.ci95_high, own.ci95_high);
    }
}

/// Rule of three: 3 contributions in all samples, each with the light of one path.
TEST(Evaluate, TheBoundIsThatOfTheRuleOfThree) {
    const Scene scene = make_dark_room();
    const Result result = run(scene, {sun(0, {10, 20})}, spec_of(Method::light_tracing, kPaths));
    const double one_path = result.budget[1].emitted.mean / kPaths;
    EXPECT_NEAR(
        result.at(0, Quantity::absorbed_flux, 1).ci95_high, 3 * one_path * .6 / kReplicates,
        1e-12 * one_path);
    EXPECT_NEAR(
        result.at(0, Quantity::incident_lower, 1).ci95_high,
        3 * one_path / kReplicates / scene.organs()[0].area, 1e-10 * one_path);
}

/// A plant of a leaf, a sensor, a triangle of no area, and an organ of two materials.
Scene make_odd_plant() {
    SceneBuilder builder = make_builder(2);
    MaterialSpec leaf{"leaf", {}, {}};
    leaf.upper = {{.reflectance = .1, .transmittance = .2}, {.reflectance = .5}};
    leaf.lower = {{.reflectance = .3}, {.reflectance = .4, .transmittance = .4}};
    builder.add_material(leaf);
    builder.add_material(diffuse("stem", .2, 0, 2));
    builder.add_material(sensor("sensor", 2));
    builder.add_organ(organ("leaf", "leaf", make_triangle({0, 0, 0}, {1, 0, .3}, {0, 1, .5})));
    builder.add_organ(organ("sensor", "sensor", floor_of(0, 1, 0, 1, 1)));
    builder.add_organ(organ("line", "leaf", make_triangle({0, 0, 0}, {1, 1, 0}, {2, 2, 0})));
    OrganSpec both = organ("both", "leaf", floor_of(1, 2, 0, 1, 0));
    both.parts.push_back({"stem", floor_of(1, 2, 1, 2, .1)});
    builder.add_organ(both);
    return std::move(builder).build();
}

Sources sun_and_sky() {
    return {sun(30, {1, 2}), sky({1, .5})};
}

TEST_P(EvaluateBothWays, QuantitiesOfAnOrganFitTogether) {
    const Scene scene = make_odd_plant();
    const Result result = trace(scene, sun_and_sky());
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        const double area = scene.organs()[i].area;
        for (std::size_t b = 0; b < 2; ++b) {
            const auto mean = [&](Quantity q) { return result.at(i, q, b).mean; };
            EXPECT_NEAR(
                mean(Quantity::absorbed_flux), area * mean(Quantity::absorbed_flux_density), 1e-12);
            EXPECT_NEAR(
                mean(Quantity::incident_upper) + mean(Quantity::incident_lower),
                mean(Quantity::incident_direct) + mean(Quantity::incident_scattered), 1e-12);
        }
    }
}

TEST_P(EvaluateBothWays, EachSideAbsorbsByItsOwnOptics) {
    const Scene scene = make_odd_plant();
    const Result result = trace(scene, sun_and_sky());
    const std::array<double, 2> upper{.7, .5};
    const std::array<double, 2> lower{.7, .2};
    for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_NEAR(
            result.at(0, Quantity::absorbed_flux_density, b).mean,
            upper[b] * result.at(0, Quantity::incident_upper, b).mean +
                lower[b] * result.at(0, Quantity::incident_lower, b).mean,
            1e-12);
    }
}

TEST_P(EvaluateBothWays, AnOrganOfTwoMaterialsIsTheirSum) {
    RunSpec spec = spec_of(GetParam(), kPaths);
    spec.max_depth = 1;
    const Result result = run(make_odd_plant(), {sun(0, {1, 1})}, spec);
    // The second part lies next to the first: each receives all light on its square metre.
    const Estimate& absorbed = result.at(3, Quantity::absorbed_flux, 0);
    EXPECT_TRUE(agrees(measured(absorbed, kReplicates), .7 + .8, .05));
}

TEST_P(EvaluateBothWays, ASensorAbsorbsNothingForSure) {
    const Result result = trace(make_odd_plant(), sun_and_sky());
    const Estimate& absorbed = result.at(1, Quantity::absorbed_flux, 0);
    EXPECT_EQ(absorbed.mean, 0);
    EXPECT_EQ(absorbed.standard_error, 0);
    EXPECT_EQ(absorbed.ci95_high, 0);
    EXPECT_GT(result.at(1, Quantity::incident_upper, 0).mean, 0);
}

TEST_P(EvaluateBothWays, AnOrganOfNoAreaReceivesNothingForSure) {
    const Result result = trace(make_odd_plant(), sun_and_sky());
    for (const QuantityEntry& entry : quantity_table()) {
        const Estimate& estimate = result.at(2, entry.quantity, 1);
        EXPECT_EQ(estimate.mean, 0) << entry.name;
        EXPECT_EQ(estimate.standard_error, 0) << entry.name;
        EXPECT_EQ(estimate.ci95_high, 0) << entry.name;
    }
    EXPECT_EQ(result.sunlit_fraction[2].ci95_high, 0);
}

/// Bands on the same paths have errors in common, which cancel in a ratio.
TEST_P(EvaluateBothWays, ARatioOfBandsIsSharperThanTheBands) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("black", 0, 0, 2));
    builder.add_organ(organ("leaf", "black", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(
        organ("shade", "black", make_triangle({.2, .2, 1}, {.9, .1, 1}, {.4, .9, 1})));
    RunSpec spec = spec_of(GetParam(), kPaths);
    spec.ratios = {"b0:b1", "b1:b0"};
    const Result result = run(std::move(builder).build(), {sun(0, {1, 2})}, spec);
    const Estimate& band = result.at(0, Quantity::incident_direct, 0);
    const Estimate& ratio = result.ratio(0, 0);
    EXPECT_GT(band.standard_error, 1e-6 * band.mean);  // far more than the ratio's
    EXPECT_LT(ratio.standard_error, 1e-10);
    EXPECT_NEAR(ratio.mean, .5, 1e-12);
    EXPECT_NEAR(result.ratio(0, 1).mean, 2, 1e-12);
}

/// One band lit by the sun, one by the sky: the ratio on leaves with contributions to one of them
/// alone had no error.
TEST_P(EvaluateBothWays, ARatioOfFewContributionsHoldsTheTruth) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .2, .2, 2));
    add_leaves(builder, random_leaves(60, .2, 1, 5));
    const Scene scene = std::move(builder).build();
    const Sources sources{sun(70, {1, .5}), sky({.3, .6})};
    RunSpec spec = spec_of(GetParam(), 1 << 16);
    spec.ratios = {"b0:b1"};
    const Result truth = run(scene, sources, spec);
    spec.paths = 64;
    double held = 0, count = 0;
    for (spec.seed = 1; spec.seed <= 10; ++spec.seed) {
        const Result few = run(scene, sources, spec);
        for (std::size_t i = 0; i < few.organs(); ++i) {
            const Estimate& e = few.ratio(i, 0);
            const Estimate& t = truth.ratio(i, 0);
            if (std::isfinite(e.standard_error)) {
                held += e.ci95_low <= t.ci95_high && t.ci95_low <= e.ci95_high ? 1 : 0;
                ++count;
            }
        }
    }
    EXPECT_GT(count, 100);
    EXPECT_GE(held / count, .95);
}

/// A leaf that scattered light may reach, but no path did: both bands have the same direct light.
TEST_P(EvaluateBothWays, ARatioOfDirectLightAloneIsNotCertain) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(
        {"leaf",
         {{.reflectance = .05}, {.reflectance = .9}},
         {{.reflectance = .05}, {.reflectance = .9}}});
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(organ("far", "leaf", floor_of(0, .01, 3, 4, 1)));
    RunSpec spec = spec_of(GetParam(), 1 << 12);
    spec.ratios = {"b0:b1"};
    const Result result = run(std::move(builder).build(), {sun(0, {1, 1})}, spec);
    const Estimate& ratio = result.ratio(0, 0);
    EXPECT_NEAR(ratio.mean, 1, 1e-2);
    EXPECT_GT(ratio.standard_error, 0);
    EXPECT_LT(ratio.ci95_low, 1);
}

TEST_P(EvaluateBothWays, ASingleReplicateHasAMeanAndNoError) {
    RunSpec spec = spec_of(GetParam(), kPaths);
    spec.replicates = 1;
    const Estimate estimate =
        run(make_odd_plant(), sun_and_sky(), spec).at(0, Quantity::absorbed_flux, 0);
    EXPECT_GT(estimate.mean, 0);
    EXPECT_TRUE(std::isnan(estimate.standard_error));
    EXPECT_TRUE(std::isnan(estimate.ci95_low));
}

/// Organs that can't absorb light are known without tracing.
TEST_P(EvaluateBothWays, OrgansThatAbsorbNothingForSureAreAtAnyTarget) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_material(sensor("sensor"));
    builder.add_organ(organ("leaf", "black", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(organ("sensor", "sensor", floor_of(0, 1, 0, 1, 1)));
    builder.add_organ(organ("line", "black", make_triangle({0, 0, 0}, {1, 1, 0}, {2, 2, 0})));
    RunSpec spec = spec_of(GetParam(), kPaths);
    spec.target_error = .1;
    spec.target_fraction = 1;
    spec.max_paths = 4 * kPaths;
    const Result result = run(std::move(builder).build(), {sun(0, {1})}, spec);
    EXPECT_EQ(result.stop, StopReason::target_reached);
    EXPECT_EQ(result.fraction_at_target, 1);
}

QUASIMC_BOTH_WAYS(EvaluateBothWays);

}  // namespace
}  // namespace quasimc::test

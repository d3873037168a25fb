// No interval extends beyond the physically possible values.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/shapes/shapes.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// A leaf of 0.1 x 0.1 and a slope, in the shade of a roof, in a scene of 4 x 4 x 4.
Scene make_shaded_slope(double slope, const std::string& material = "leaf") {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .1));
    builder.add_material(sensor("sensor"));
    std::vector<Triangle> leaf = floor_of(0, .1, 0, .1, 1);
    for (Triangle& triangle : leaf) {
        for (Vec3& corner : triangle) {
            corner.z += slope * corner.x;
        }
    }
    builder.add_organ(organ("leaf", material, leaf));
    builder.add_organ(organ("roof", "leaf", floor_of(-2, 2, -2, 2, 4)));
    builder.add_organ(organ("floor", "leaf", floor_of(-2, 2, -2, 2, 0)));
    return std::move(builder).build();
}

class PhysicalBounds : public BothWays {
  protected:
    [[nodiscard]] Result few(const Scene& scene, const Sources& sources) const {
        RunSpec spec = spec_of(GetParam(), 16);
        spec.replicates = 4;
        return run(scene, sources, spec);
    }
    static double direct_high(const Result& result) {
        return result.at(0, Quantity::incident_direct, 0).ci95_high;
    }
};

TEST_P(PhysicalBounds, DirectLightOfASunIsAtMostWhatFallsOnTheSlope) {
    for (const double slope : {0.0, .5, 1000.0, 1e6}) {
        const Scene scene = make_shaded_slope(slope);
        const double cosine = 1 / std::hypot(slope, 1);
        const Result result = few(scene, {sun(0, {3})});
        EXPECT_LE(direct_high(result), 3 * cosine * (1 + 1e-12)) << slope;
        EXPECT_GE(direct_high(result), 0) << slope;
    }
}

TEST_P(PhysicalBounds, DirectLightOfASkyIsAtMostThatOfTheOpenField) {
    const Scene scene = make_shaded_slope(0);
    EXPECT_LE(direct_high(few(scene, {sky({2})})), 2 * (1 + 1e-12));
    EXPECT_LE(direct_high(few(scene, {sky({2}), sun(0, {3})})), 5 * (1 + 1e-12));
}

TEST_P(PhysicalBounds, AnOrganIsSunlitToAtMostAllOfIt) {
    for (const double slope : {0.0, .5, 1000.0, 1e6}) {
        const Result result = few(make_shaded_slope(slope), {sun(0, {3})});
        for (std::size_t i = 0; i < result.organs(); ++i) {
            EXPECT_LE(result.sunlit_fraction[i].ci95_high, 1) << slope << " organ " << i;
        }
        for (const Estimate& group : result.groups.sunlit_fraction) {
            EXPECT_LE(group.ci95_high, 1 + 1e-12) << slope;
        }
    }
}

TEST_P(PhysicalBounds, NoPartOfTheLightIsMoreThanAll) {
    const Result result = few(make_shaded_slope(.5), {sun(30, {3}), sky({1})});
    const double emitted = result.budget[0].emitted.mean * (1 + 1e-3);
    for (std::size_t i = 0; i < result.organs(); ++i) {
        EXPECT_LE(result.at(i, Quantity::absorbed_flux, 0).ci95_high, emitted);
    }
    EXPECT_LE(result.budget[0].absorbed_by_organs.ci95_high, emitted);
    EXPECT_LE(result.groups.at(0, Quantity::absorbed_flux, 0).ci95_high, emitted);
}

TEST_P(PhysicalBounds, NoOrganAbsorbsMoreThanFallsOnIt) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("plate", "black", floor_of(0, 2, 0, 2, 0)));
    const Scene scene = std::move(builder).build();
    const Result result = few(scene, {sun(0, {1000})});
    const double most = 4000 * (1 + 1e-12);
    EXPECT_LE(reported(result.at(0, Quantity::absorbed_flux, 0)).mean, most);
    EXPECT_LE(result.at(0, Quantity::absorbed_flux, 0).ci95_high, most);
    EXPECT_LE(result.groups.at(0, Quantity::absorbed_flux, 0).ci95_high, most);
    EXPECT_NEAR(reported(result.at(0, Quantity::incident_upper, 0)).mean, 1000, 1);
    EXPECT_LE(reported(result.at(0, Quantity::incident_upper, 0)).mean, 1000 * (1 + 1e-12));
}

/// The interval contains the truth: for an unshaded leaf that all methods sample.
TEST_P(PhysicalBounds, WhatIsReachedIsNotCutOff) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .1));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, 0)));
    const Scene scene = std::move(builder).build();
    const Result result = few(scene, {sun(40, {3}), sky({2})});
    const double truth = 2 + 3 * std::cos(40 * std::numbers::pi / 180);
    EXPECT_NEAR(direct_high(result), truth, 1e-5 * truth);
    EXPECT_LE(result.at(0, Quantity::incident_direct, 0).ci95_low, truth * (1 + 1e-5));
    EXPECT_EQ(result.sunlit_fraction[0].ci95_high, 1);
}

/// A sun exactly parallel to a surface lights neither of its sides, whatever cosines of 1e-17
/// rounding leaves.
TEST_P(PhysicalBounds, ASunAlongASurfaceLightsNoneOfIt) {
    for (const double turned : {0.0, .3, 1.0, 2.5}) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .3, .1));
        const Vec3 along{std::cos(turned), std::sin(turned), 0};
        builder.add_organ(
            organ("wall", "leaf", make_triangle({0, 0, 0}, along, along + Vec3{0, 0, 1})));
        builder.add_organ(organ("floor", "leaf", floor_of(-2, 2, -2, 2, -1)));
        const Result result = trace(std::move(builder).build(), {sun(0, {1})}, 1 << 12);
        EXPECT_EQ(result.sunlit_fraction[0].mean, 0) << turned;
        EXPECT_EQ(result.sunlit_fraction[0].ci95_high, 0) << turned;
        EXPECT_NEAR(result.sunlit_fraction[1].mean, 1, 1e-4) << turned;
    }
}

QUASIMC_BOTH_WAYS(PhysicalBounds);

/// An unshaded leaf of the given slope, above a floor.
Scene make_open_slope(double slope) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .1));
    std::vector<Triangle> leaf = floor_of(-.05, .05, -.05, .05, 1);
    for (Triangle& triangle : leaf) {
        for (Vec3& corner : triangle) {
            corner.z += slope * corner.x;
        }
    }
    builder.add_organ(organ("leaf", "leaf", leaf));
    builder.add_organ(organ("floor", "leaf", floor_of(-1, 1, -1, 1, 0)));
    return std::move(builder).build();
}

void expect_possible(const Estimate& e, double most) {
    const Estimate r = reported(e);
    EXPECT_LE(r.ci95_low, r.mean);
    EXPECT_LE(r.mean, r.ci95_high);
    EXPECT_GE(r.mean, 0);
    EXPECT_LE(r.mean, most);
}

class ReportedMeans : public ::testing::TestWithParam<Method> {};

/// Means scatter beyond the possible values, and are reported at the limit. Sums use the unclipped
/// means, and the budget adds up.
TEST_P(ReportedMeans, LieInTheirIntervalsAndInWhatIsPossible) {
    int beyond = 0;
    for (const double slope : {0.0, 1.0, 20.0}) {
        const Scene scene = make_open_slope(slope);
        const double direct = 3 / std::hypot(slope, 1) * (1 + 1e-12);
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            RunSpec spec = spec_of(GetParam(), 64);
            spec.seed = seed;
            const Result result = run(scene, {sun(0, {3})}, spec);
            const Estimate& leaf = result.at(0, Quantity::incident_direct, 0);
            const Estimate& floor = result.at(1, Quantity::incident_direct, 0);
            expect_possible(leaf, direct);
            expect_possible(floor, 3 * (1 + 1e-12));
            expect_possible(result.sunlit_fraction[0], 1);
            expect_possible(result.groups.sunlit_fraction[0], 1);
            beyond += leaf.mean > direct || result.sunlit_fraction[0].mean > 1 ? 1 : 0;

            const double leaf_area = scene.organs()[0].area, floor_area = scene.organs()[1].area;
            const double both = leaf.mean * leaf_area + floor.mean * floor_area;
            EXPECT_NEAR(
                result.groups.at(0, Quantity::incident_direct, 0).mean * (leaf_area + floor_area),
                both, 1e-12 * both);
            const BandBudget& budget = result.budget[0];
            const double parts = budget.absorbed_by_organs.mean + budget.absorbed_by_ground.mean +
                                 budget.escaped.mean + budget.cut_off.mean;
            EXPECT_NEAR(parts, budget.emitted.mean + budget.imbalance.mean, 1e-6 * parts);
            for (const Estimate& e :
                 {budget.absorbed_by_organs, budget.absorbed_by_ground, budget.escaped}) {
                EXPECT_LE(e.ci95_low, e.mean);
                EXPECT_LE(e.mean, e.ci95_high);
            }
        }
    }
    EXPECT_GT(beyond, 0) << "a control: nothing had to be cut";
}

INSTANTIATE_TEST_SUITE_P(
    Ways,
    ReportedMeans,
    ::testing::Values(
        Method::light_tracing, Method::from_organs, Method::first_hits, Method::ray_bundles),
    name_of);

}  // namespace
}  // namespace quasimc::test

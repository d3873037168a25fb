// Light is neither made nor lost: emitted = absorbed by organs + by the ground + escaped + cut off,
// to rounding, in every run.

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "invariance/plot.h"
#include "samplers/catalogue.h"

namespace quasimc::test {
namespace {

void expect_closed(const Result& result) {
    for (const BandBudget& budget : result.budget) {
        EXPECT_GT(budget.emitted.mean, 0);
        EXPECT_LE(budget.closure_error, 1e-12);
        // The five numbers that are reported close as well as each replicate.
        const double rest = budget.emitted.mean + budget.imbalance.mean -
                            budget.absorbed_by_organs.mean - budget.absorbed_by_ground.mean -
                            budget.escaped.mean - budget.cut_off.mean;
        EXPECT_LE(std::abs(rest), 1e-12 * budget.emitted.mean);
    }
}

/// What the organs report of themselves is what the budget says.
void expect_consistent(const Scene& scene, const Result& result) {
    for (std::size_t b = 0; b < result.bands; ++b) {
        double organs = 0;
        double ground = 0;
        for (std::size_t i = 0; i < result.organs(); ++i) {
            (scene.organs()[i].is_ground ? ground : organs) +=
                result.at(i, Quantity::absorbed_flux, b).mean;
        }
        const BandBudget& budget = result.budget[b];
        EXPECT_NEAR(organs, budget.absorbed_by_organs.mean, 1e-12 * budget.emitted.mean);
        EXPECT_NEAR(ground, budget.absorbed_by_ground.mean, 1e-12 * budget.emitted.mean);
    }
}

/// The ways of tracing that follow light.
class FollowedEnergy : public ::testing::TestWithParam<Method> {};

TEST_P(FollowedEnergy, ClosesForEverySampler) {
    const Scene scene = make_plot({});
    for (const SamplerEntry& sampler : sampler_catalogue()) {
        SCOPED_TRACE(sampler.name);
        RunSpec spec = spec_of(GetParam(), 1 << 9);
        spec.sampler = sampler.name;
        const Result result = run(scene, plot_sources({}), spec);
        expect_closed(result);
        expect_consistent(scene, result);
        EXPECT_FALSE(result.escaped_by_difference);
        EXPECT_EQ(result.budget[0].cut_off.mean, 0);
    }
}

TEST_P(FollowedEnergy, ClosesForEverySourceAlone) {
    const Scene scene = make_plot({});
    for (const auto& source : plot_sources({})) {
        SCOPED_TRACE(source->name());
        expect_closed(run(scene, {source}, spec_of(GetParam(), 1 << 9)));
    }
}

TEST_P(FollowedEnergy, ClosesInPeriodicCells) {
    for (const auto& [x, y] : {std::pair{true, false}, {false, true}, {true, true}}) {
        SceneBuilder builder = make_builder(kPlotBands);
        for (const MaterialSpec& material : plot_materials({0, 1, 2})) {
            builder.add_material(material);
        }
        for (const Triangle& leaf : plot_leaves()) {
            builder.add_organ(organ("", "leaf", {leaf}));
        }
        builder.set_cell({.along_x = x, .along_y = y, .size_x = .7, .size_y = .9});
        expect_closed(
            run(std::move(builder).build(), plot_sources({}), spec_of(GetParam(), 1 << 9)));
    }
}

TEST_P(FollowedEnergy, CutOffIsReportedAndCloses) {
    const Scene scene = make_plot({});
    double before = INFINITY;
    for (const std::uint32_t depth : {1U, 2U, 4U}) {
        RunSpec spec = spec_of(GetParam(), 1 << 9);
        spec.max_depth = depth;
        const Result result = run(scene, plot_sources({}), spec);
        expect_closed(result);
        EXPECT_GT(result.budget[0].cut_off.mean, 0);
        EXPECT_LT(result.budget[0].cut_off.mean, before);
        before = result.budget[0].cut_off.mean;
    }
}

INSTANTIATE_TEST_SUITE_P(
    EveryWay,
    FollowedEnergy,
    ::testing::Values(Method::light_tracing, Method::first_hits),
    [](const auto& way) {
        return std::string(way.param == Method::light_tracing ? "Sources" : "LitSurfaces");
    });

TEST(Energy, RouletteGivesAsMuchAsItTakes) {
    const Scene scene = make_plot({});
    const Result result = run(scene, plot_sources({}), spec_of(Method::light_tracing, 1 << 12));
    for (const BandBudget& budget : result.budget) {
        EXPECT_GT(budget.imbalance.standard_error, 0);
        EXPECT_TRUE(agrees(
            measured(budget.imbalance, kReplicates), 0, .03 * budget.emitted.mean,
            sidak_level(kLevel, kPlotBands)));
    }
}

/// Seen from the organs, the light emitted is known, and what escaped is what is left.
TEST(Energy, EscapedIsTheRemainderSeenFromTheOrgans) {
    const Scene scene = make_plot({});
    const Result forward = run(scene, plot_sources({}), spec_of(Method::light_tracing, 1 << 11));
    const Result backward = run(scene, plot_sources({}), spec_of(Method::from_organs, 1 << 12));
    EXPECT_TRUE(backward.escaped_by_difference);
    expect_closed(backward);
    expect_consistent(scene, backward);
    for (std::size_t b = 0; b < kPlotBands; ++b) {
        const double emitted = backward.budget[b].emitted.mean;
        EXPECT_NEAR(emitted, forward.budget[b].emitted.mean, 1e-2 * emitted);
        EXPECT_TRUE(agrees(
            measured(backward.budget[b].escaped, kReplicates),
            measured(forward.budget[b].escaped, kReplicates), .1 * emitted,
            sidak_level(kLevel, kPlotBands)));
    }
}

}  // namespace
}  // namespace quasimc::test

// Scenes without light: exact zeros, no error.

#include <gtest/gtest.h>

#include "light/models/source.h"
#include "quasimc/series.h"
#include "run/simulator.h"
#include "statistical/scenes.h"
#include "support/listening.h"

namespace quasimc::test {
namespace {

/// A leaf in the plane of y and z: light along y or z, or down, is edge-on.
Scene upright_leaf() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .4, .2));
    const Vec3 low{}, right{0, 1, 0}, far{0, 1, 1}, high{0, 0, 1};
    builder.add_organ(organ("leaf", "leaf", {Triangle{low, right, far}, Triangle{low, far, high}}));
    return std::move(builder).build();
}

void expect_zero(const Estimate& e, std::string_view what) {
    EXPECT_EQ(e.mean, 0) << what;
    EXPECT_EQ(e.standard_error, 0) << what;
    EXPECT_EQ(e.ci95_low, 0) << what;
    EXPECT_EQ(e.ci95_high, 0) << what;
}

void expect_unlit(const Result& result) {
    EXPECT_EQ(result.stop, StopReason::no_light);
    for (const QuantityEntry& entry : quantity_table()) {
        expect_zero(result.at(0, entry.quantity, 0), entry.name);
    }
    ASSERT_EQ(result.sunlit_fraction.size(), 1U);
    expect_zero(result.sunlit_fraction[0], "sunlit");
    EXPECT_EQ(result.budget[0].emitted.mean, 0);
    EXPECT_EQ(result.budget[0].closure_error, 0);
    expect_zero(result.budget[0].escaped, "escaped");
    EXPECT_EQ(result.paths, 0U);
}

class Unlit : public ::testing::TestWithParam<Method> {
  protected:
    static RunSpec spec() {
        RunSpec spec = spec_of(GetParam(), 1024);
        spec.replicates = 4;
        return spec;
    }
};

INSTANTIATE_TEST_SUITE_P(
    By,
    Unlit,
    ::testing::Values(
        Method::light_tracing, Method::first_hits, Method::from_organs, Method::automatic),
    [](const auto& test) {
        return test.param == Method::light_tracing ? "LightTracing"
               : test.param == Method::first_hits  ? "FirstHits"
               : test.param == Method::from_organs ? "FromOrgans"
                                                   : "Automatic";
    });

TEST_P(Unlit, LeafEdgeOnToTheSunHasExactZeros) {
    RunSpec all = spec();
    all.audit = .1;
    all.target_error = .01;
    const Result result = run(upright_leaf(), {sun(0, {1})}, all);
    expect_unlit(result);
    EXPECT_EQ(result.fraction_at_target, 1);
    ASSERT_TRUE(result.audit);
    EXPECT_TRUE(result.audit->agrees());
    EXPECT_NE(result.chosen.method, Method::automatic);
    EXPECT_NE(result.chosen.reason.find("no light reaches"), std::string::npos);
}

/// Other sources light it independently of the hidden sun.
TEST_P(Unlit, SunAmongOthersChangesNothing) {
    const Scene scene = upright_leaf();
    const Result alone = run(scene, {sun(60, {1})}, spec());
    const Result both = run(scene, {sun(0, {5}), sun(60, {1})}, spec());
    EXPECT_EQ(both.stop, StopReason::finished);
    const Quantity q = Quantity::incident_direct;
    EXPECT_GT(both.at(0, q, 0).mean, .5);
    EXPECT_EQ(both.at(0, q, 0).mean, alone.at(0, q, 0).mean);
    EXPECT_LT(both.budget[0].closure_error, 1e-9);
}

TEST_P(Unlit, SunUnderASkyLightsNoPartOfTheLeaf) {
    const Result result = run(upright_leaf(), {sun(0, {1}), sky({1})}, spec());
    EXPECT_GT(result.at(0, Quantity::incident_direct, 0).mean, .1);
    ASSERT_EQ(result.sunlit_fraction.size(), 1U);
    expect_zero(result.sunlit_fraction[0], "sunlit");
}

TEST_P(Unlit, HourOfASeriesIsOneOfZeros) {
    const std::vector<TimeStep> times{
        {"noon", {sun(0, {1})}, "0", 3600, 0}, {"evening", {sun(60, {1})}, "60", 3600, 0}};
    std::vector<Result> results;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        results.push_back(result);
    };
    const SeriesSummary summary =
        run_series(upright_leaf(), times, spec(), {.listeners = {&events}});
    ASSERT_EQ(results.size(), 2U);
    expect_unlit(results[0]);
    EXPECT_GT(results[1].at(0, Quantity::incident_direct, 0).mean, .5);
    EXPECT_EQ(summary.unlit, 1U);
    EXPECT_EQ(
        summary.total.at(0, Quantity::incident_direct, 0).mean,
        3600 * results[1].at(0, Quantity::incident_direct, 0).mean);
}

TEST_P(Unlit, SumsAddUpAndSayZero) {
    const Scene scene = upright_leaf();
    RunSpec one = spec();
    Simulator simulator;
    Sums sums = load_sums(save_sums(simulator.sums(scene, {sun(0, {1})}, one)));
    sums += simulator.sums(scene, {sun(0, {1})}, one, one.paths);
    EXPECT_EQ(sums.paths(), 2 * one.paths);
    const Result result = evaluate_run(sums, scene, one);
    for (const QuantityEntry& entry : quantity_table()) {
        expect_zero(result.at(0, entry.quantity, 0), entry.name);
    }
    EXPECT_EQ(result.budget[0].closure_error, 0);
}

/// Sensors receive nothing of a sun that they are edge-on to.
TEST_P(Unlit, SensorSeesNothing) {
    SceneBuilder builder = make_builder();
    builder.add_material(sensor("glass"));
    builder.add_organ(
        organ("sensor", "glass", {Triangle{Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 1, 1}}}));
    expect_unlit(run(std::move(builder).build(), {sun(0, {1})}, spec()));
}

TEST(UnlitSeries, OfNightsAloneIsOneOfZeros) {
    const std::vector<TimeStep> times{{"night", {}, "", 3600, 0}, {"night", {}, "", 3600, 1}};
    std::size_t reported = 0;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        ++reported;
        expect_zero(result.at(0, Quantity::absorbed_flux, 0), "absorbed");
        EXPECT_EQ(result.budget[0].closure_error, 0);
    };
    const SeriesSummary summary =
        run_series(upright_leaf(), times, spec_of(Method::automatic, 64), {.listeners = {&events}});
    EXPECT_EQ(reported, 2U);
    EXPECT_EQ(summary.computed, 0U);
    expect_zero(summary.total.at(0, Quantity::absorbed_flux, 0), "total");
}

}  // namespace
}  // namespace quasimc::test

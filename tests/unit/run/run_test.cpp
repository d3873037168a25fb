#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/shapes/shapes.h"
#include "light/models/source.h"
#include "quasimc/series.h"
#include "statistical/scenes.h"
#include "support/listening.h"

namespace quasimc::test {
namespace {

/// A uniform sky in which every 512th sample takes three milliseconds.
class TiredSky final : public SourceModel {
  public:
    TiredSky() : SourceModel("tired", {1}, kSkyTraits, 1), sky_(make_uniform_sky("sky", {1})) {}
    [[nodiscard]] ModelParameters parameters() const override { return {"tired_sky", {}}; }
    [[nodiscard]] std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const override {
        return model_of(*sky_).make_sampler_in(projection);
    }
    [[nodiscard]] Illumination illuminate(const Vec3& point, double u0, double u1) const override {
        constexpr unsigned kBetween = 512;
        if (++samples_ % kBetween == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(3));
        }
        return model_of(*sky_).illuminate(point, u0, u1);
    }
    [[nodiscard]] double radiance(const Vec3& to_light) const override {
        return model_of(*sky_).radiance(to_light);
    }

  private:
    std::shared_ptr<const Source> sky_;
    mutable std::atomic<unsigned> samples_{0};
};

/// A run of half a second or more on two threads.
RunSpec long_run() {
    RunSpec spec;
    spec.method = Method::from_organs;
    spec.threads = 2;
    spec.paths = 1U << 14U;
    spec.replicates = 10;
    return spec;
}

TEST(Progress, IsReportedFromTheCallingThreadAlone) {
    const auto caller = std::this_thread::get_id();
    int calls = 0;
    double before = 0;
    Listening listening;
    listening.progress = [&](const Progress& progress) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        EXPECT_GT(progress.fraction, before);
        EXPECT_LE(progress.fraction, 1);
        EXPECT_GT(progress.seconds, 0);
        EXPECT_GE(progress.expected_seconds, progress.seconds);
        before = progress.fraction;
        ++calls;
    };
    (void)run(
        leaf_over_ground(), {std::make_shared<TiredSky>()}, long_run(),
        {.listeners = {&listening}});
    EXPECT_GT(calls, 0);
}

/// With equal shares for all times, tracing would be only the last hundredth.
TEST(Progress, OfASeriesIsThatOfTheTimesThatAreTraced) {
    std::vector<TimeStep> times(99);
    times.emplace_back().sources = {std::make_shared<TiredSky>()};
    std::vector<double> fractions;
    Listening events;
    events.progress = [&](const Progress& progress) { fractions.push_back(progress.fraction); };
    run_series(leaf_over_ground(), times, long_run(), {.listeners = {&events}});
    ASSERT_FALSE(fractions.empty());
    EXPECT_LT(fractions.front(), .99);
    EXPECT_LE(fractions.back(), 1);
}

TEST(Progress, AnExceptionOfTheListenerEndsTheRun) {
    Listening listening;
    listening.progress = [](const Progress&) { throw std::runtime_error("enough"); };
    EXPECT_THROW(
        (void)run(
            leaf_over_ground(), {std::make_shared<TiredSky>()}, long_run(),
            {.listeners = {&listening}}),
        std::runtime_error);
}

/// Overloads are unambiguous.
TEST(Run, TakesEmptyBracesForItsControl) {
    const Scene scene = leaf_over_ground();
    const Sources sources{sky({1})};
    const RunSpec spec = spec_of(Method::light_tracing, 64);
    Simulator simulator;
    const double free = run(scene, sources, spec, {}).at(0, Quantity::absorbed_flux, 0).mean;
    EXPECT_EQ(simulator.run(scene, sources, spec, {}).at(0, Quantity::absorbed_flux, 0).mean, free);
    std::vector<TimeStep> steps(1);
    steps[0].sources = sources;
    EXPECT_EQ(run_series(scene, steps, spec, {}).computed, 1U);
    EXPECT_EQ(run_series(simulator, scene, steps, spec, {}).computed, 1U);
    EXPECT_EQ(run_series(std::move(simulator), scene, steps, spec, {}).computed, 1U);
}

/// Parts of work are fractions of the whole, at any depth of the tree.
TEST(Progress, OfAPartIsThatOfTheWhole) {
    std::vector<double> fractions;
    Listening listening;
    listening.progress = [&](const Progress& now) { fractions.push_back(now.fraction); };
    const Work whole({&listening});
    const Work later = whole.part(.5, .5).part(.5, .25);
    later.report(0);
    later.report(1);
    whole.report(.25);  // progress does not decrease
    EXPECT_EQ(fractions, (std::vector<double>{.75, .875, .875}));
    Work().report(1);
    EXPECT_TRUE(Work().is_empty());
}

TEST(Deadline, OfAShareComesBeforeThatOfAll) {
    EXPECT_TRUE(Deadline().is_never());
    EXPECT_TRUE(Deadline().share(.5).is_never());
    EXPECT_EQ(Deadline().seconds_left(), INFINITY);
    const Deadline all = Deadline::after(100);
    const Deadline half = all.share(.5);
    EXPECT_NEAR(half.seconds_left(), 50, 1);
    EXPECT_NEAR(std::chrono::duration<double>(all.latest() - all.at()).count(), 3, 1e-6);
    EXPECT_GE(half.latest(), all.at()) << "its first paths may take all of the time";
    EXPECT_FALSE(half.is_over());
    EXPECT_TRUE(Deadline::after(0).is_over());
}

TEST(Run, StopsWhenTheTargetIsReached) {
    RunSpec spec = spec_of(Method::light_tracing, 256);
    spec.target_error = .01;
    spec.target_fraction = 1;
    const Result result = run(leaf_over_ground(), {sky({1})}, spec);
    EXPECT_EQ(result.stop, StopReason::target_reached);
    EXPECT_EQ(result.fraction_at_target, 1);
    EXPECT_GT(result.paths, 256U);
    for (const std::size_t organ : {0U, 1U}) {
        const Estimate& absorbed = result.at(organ, Quantity::absorbed_flux, 0);
        EXPECT_LE(absorbed.standard_error, .01 * absorbed.mean);
    }
}

TEST(Run, SaysWhyItMissedTheTarget) {
    RunSpec spec = spec_of(Method::light_tracing, 256);
    spec.target_error = 1e-9;
    spec.max_paths = 1000;
    Result result = run(leaf_over_ground(), {sky({1})}, spec);
    EXPECT_EQ(result.stop, StopReason::path_limit);
    EXPECT_EQ(result.paths, 512U);
    spec.max_seconds = 1e-9;
    spec.max_paths = 0;
    result = run(leaf_over_ground(), {sky({1})}, spec);
    EXPECT_EQ(result.stop, StopReason::time_limit);
    EXPECT_EQ(result.paths, 256U);
}

class RunBothWays : public BothWays {};

/// Doubling rounds give the same as one long run, with the same error.
TEST_P(RunBothWays, RoundsAddUp) {
    RunSpec spec = spec_of(GetParam(), 512);
    spec.max_paths = 8192;
    const Result rounds = run(leaf_over_ground(), {sun(20, {1}), sky({1})}, spec);
    EXPECT_EQ(rounds.paths, 8192U);
    spec.paths = 8192;
    spec.seed = 2;
    const Result once = run(leaf_over_ground(), {sun(20, {1}), sky({1})}, spec);
    for (const std::size_t organ : {0U, 1U}) {
        const Estimate& a = rounds.at(organ, Quantity::incident_scattered, 0);
        const Estimate& b = once.at(organ, Quantity::incident_scattered, 0);
        EXPECT_TRUE(agrees(
            measured(a, kReplicates), measured(b, kReplicates), .15 * b.mean,
            sidak_level(kLevel, 2)));
        EXPECT_LT(a.standard_error, 3 * b.standard_error);
    }
}

TEST_P(RunBothWays, ThreadsAreThoseOfTheMachineUnlessGiven) {
    RunSpec spec = spec_of(GetParam(), 1024);
    const Estimate one =
        run(leaf_over_ground(), {sky({1})}, spec).at(0, Quantity::absorbed_flux, 0);
    spec.threads = 0;
    const Estimate all =
        run(leaf_over_ground(), {sky({1})}, spec).at(0, Quantity::absorbed_flux, 0);
    EXPECT_EQ(one.mean, all.mean);
    EXPECT_EQ(one.standard_error, all.standard_error);
}

TEST_P(RunBothWays, AnotherSeedGivesOtherNumbers) {
    RunSpec spec = spec_of(GetParam(), 1024);
    const Scene scene = leaf_over_ground();
    const double first = run(scene, {sky({1})}, spec).at(0, Quantity::absorbed_flux, 0).mean;
    EXPECT_EQ(first, run(scene, {sky({1})}, spec).at(0, Quantity::absorbed_flux, 0).mean);
    spec.seed = 2;
    EXPECT_NE(first, run(scene, {sky({1})}, spec).at(0, Quantity::absorbed_flux, 0).mean);
}

TEST_P(RunBothWays, WithADepthOfOneNothingIsScattered) {
    RunSpec spec = spec_of(GetParam(), 1024);
    spec.max_depth = 1;
    const Result result = run(leaf_over_ground(), {sun(0, {1})}, spec);
    for (const std::size_t organ : {0U, 1U}) {
        EXPECT_EQ(result.at(organ, Quantity::incident_scattered, 0).mean, 0);
        EXPECT_GT(result.at(organ, Quantity::incident_direct, 0).mean, 0);
    }
}

/// All light that would be scattered is cut off.
TEST(Run, ReportsWhatADepthOfOneCutsOff) {
    RunSpec spec = spec_of(Method::light_tracing, 1024);
    spec.max_depth = 1;
    const Result result = run(leaf_over_ground(.4, .2), {sun(0, {1})}, spec);
    const BandBudget& budget = result.budget[0];
    EXPECT_NEAR(
        budget.cut_off.mean,
        .6 / .4 * budget.absorbed_by_organs.mean + .3 / .7 * budget.absorbed_by_ground.mean,
        1e-7 * budget.emitted.mean);
    EXPECT_NEAR(budget.imbalance.mean, 0, 1e-7) << "the fixed point of the tallies";
}

TEST_P(RunBothWays, LightFromBelowFallsOnLowerSides) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .4, .2));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, .5)));
    const Scene scene = std::move(builder).build();
    const auto below = make_directional_source("below", {0, .6, .8}, {1});
    const Result result = trace(scene, {below}, 1024);
    EXPECT_EQ(result.at(0, Quantity::incident_upper, 0).mean, 0);
    // Start areas are larger than the scene by a millionth; scan lines have some noise.
    const Estimate& lower = result.at(0, Quantity::incident_lower, 0);
    constexpr double kQuantile = 6;
    EXPECT_NEAR(lower.mean, .8, 1e-5 + kQuantile * lower.standard_error);
    EXPECT_LT(lower.standard_error, 1e-3);
}

/// A band without light is dark, and nothing is divided by zero.
TEST_P(RunBothWays, ABandWithoutLightIsDark) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .4, .2, 2));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, .5)));
    const Result result = trace(std::move(builder).build(), {sun(0, {0, 1}), sky({0, 2})}, 1024);
    for (const QuantityEntry& entry : quantity_table()) {
        EXPECT_EQ(result.at(0, entry.quantity, 0).mean, 0) << entry.name;
        EXPECT_EQ(result.at(0, entry.quantity, 0).ci95_high, 0) << entry.name;
    }
    EXPECT_EQ(result.budget[0].emitted.mean, 0);
    EXPECT_EQ(result.budget[0].closure_error, 0);
    EXPECT_GT(result.at(0, Quantity::absorbed_flux, 1).mean, 0);
}

QUASIMC_BOTH_WAYS(RunBothWays);

/// A leaf coplanar with another, one under a roof and one edge-on to the sun get nothing: no number
/// of paths samples any light there.
TEST(Targets, AreReachedWhereOrgansCanHaveNoLight) {
    for (const Method method : {Method::light_tracing, Method::first_hits, Method::from_organs}) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", 0, 0));
        builder.add_organ(organ("roof", "leaf", floor_of(0, 1, 0, 1, 1)));
        builder.add_organ(organ("on roof", "leaf", floor_of(0, 1, 0, 1, 1)));
        builder.add_organ(organ("below", "leaf", floor_of(.4, .6, .4, .6, 0)));
        builder.add_organ(organ("edge-on", "leaf", {{Vec3{2, 0, 0}, {2, 1, 0}, {2, 0, 1}}}));
        RunSpec spec = spec_of(method, 256);
        spec.target_error = .05;
        spec.target_fraction = 1;
        spec.max_paths = 1 << 18;
        const Result result = run(std::move(builder).build(), {sun(0, {1})}, spec);
        EXPECT_EQ(result.stop, StopReason::target_reached) << static_cast<int>(method);
        EXPECT_EQ(result.at(1, Quantity::absorbed_flux, 0).mean, 0);
        EXPECT_EQ(result.at(2, Quantity::absorbed_flux, 0).mean, 0);
    }
}

/// Half of the errors of the organs' absorbed flux are smaller than the median; and the largest.
std::pair<double, double> spread_in(const Scene& scene, const Result& result) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        const Estimate& e = result.at(i, Quantity::absorbed_flux, 0);
        if (!scene.organs()[i].is_ground && std::isfinite(e.standard_error / e.mean)) {
            errors.push_back(e.standard_error / e.mean);
        }
    }
    std::sort(errors.begin(), errors.end());
    return {errors[errors.size() / 2], errors.back()};
}

TEST(Run, ReportsTheErrorsOfEachRound) {
    const Scene scene = leaf_over_ground();
    const Sources sources{sun(30, {1}), sky({.5})};
    RunSpec spec = spec_of(Method::light_tracing, 256);
    EXPECT_TRUE(run(scene, sources, spec).rounds.empty()) << "one round";
    spec.max_paths = 2048;
    const Result result = run(scene, sources, spec);
    ASSERT_EQ(result.rounds.size(), 4U);
    for (std::size_t i = 0; i < result.rounds.size(); ++i) {
        const RoundErrors& round = result.rounds[i];
        EXPECT_EQ(round.paths, 256U << i);
        spec.max_paths = round.paths;
        const auto [median, worst] = spread_in(scene, run(scene, sources, spec));
        EXPECT_DOUBLE_EQ(round.median, median);
        EXPECT_DOUBLE_EQ(round.worst, worst);
    }
}

}  // namespace
}  // namespace quasimc::test

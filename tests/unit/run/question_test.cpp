// The light whose errors count: of organs, groups, the total or sensors.

#include "results/question.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "results/evaluate.h"
#include "run/evaluation_of.h"
#include "run/simulator.h"
#include "statistical/scenes.h"
#include "sums/sum_data.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr std::uint32_t kLeaves = 9, kSensor = kLeaves;

/// Three plants of three leaves, a sensor among them, a leaf that is not measured, and a soil.
Scene make_plants() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .3, .2, 2));
    builder.add_material(diffuse("soil", .2, 0, 2));
    builder.add_material(sensor("sensor", 2));
    const auto leaves = random_leaves(kLeaves, .6, 1, 3);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        builder.add_organ(
            labelled(organ("", "leaf", {leaves[i]}), {{"plant", std::string(1, "abc"[i / 3])}}));
    }
    builder.add_organ(
        labelled(organ("eye", "sensor", floor_of(.4, .6, .4, .6, .1)), {{"plant", "eye"}}));
    OrganSpec border = organ("border", "leaf", floor_of(0, .2, 0, .2, .3));
    border.measured = false;
    builder.add_organ(std::move(border));
    GroundSpec soil = ground("soil");
    soil.height = -.4;
    builder.set_ground(soil);
    return std::move(builder).build();
}

Sources day_light() {
    return {sun(30, {1, 2}), sky({.5, .2})};
}

RunSpec small_spec() {
    RunSpec spec = spec_of(Method::light_tracing, 2048);
    spec.replicates = 8;
    spec.groups = {"plant"};
    return spec;
}

/// A run whose errors are asked for.
struct Traced {
    explicit Traced(const RunSpec& given, Sources lights = day_light())
        : scene(make_plants()),
          sources(std::move(lights)),
          spec(given),
          sums(Simulator().sums(scene, sources, spec)) {}

    [[nodiscard]] EvaluationSpec asked(
        TargetScope scope,
        const std::string& quantity = "auto",
        std::vector<std::string> bands = {}) const {
        RunSpec own = spec;
        own.target = scope;
        own.target_quantity = quantity;
        own.target_bands = std::move(bands);
        return evaluation_of(scene, sources, own);
    }
    [[nodiscard]] ErrorsSoFar errors(const EvaluationSpec& asked, double target = .02) const {
        return errors_so_far(sums, scene, asked, {target, .5});
    }

    Scene scene;
    Sources sources;
    RunSpec spec;
    Sums sums;
};

double relative(const Estimate& e) {
    return e.standard_error / e.mean;
}

TEST(Question, OfGroupsAndTheTotalHasTheErrorsOfTheResult) {
    const Traced run(small_spec());
    const Result result = evaluate(run.sums, run.scene, run.asked(TargetScope::groups));
    const RoundErrors total = run.errors(run.asked(TargetScope::total, "auto", {"b1"})).round;
    EXPECT_DOUBLE_EQ(total.worst, relative(result.groups.at(0, Quantity::absorbed_flux, 1)));
    EXPECT_EQ(total.worst, total.median);
    double worst = 0;
    for (const std::size_t group : {1U, 2U, 3U}) {
        for (const std::size_t band : {0U, 1U}) {
            worst =
                std::max(worst, relative(result.groups.at(group, Quantity::incident_upper, band)));
        }
    }
    for (const std::size_t band : {0U, 1U}) {
        worst = std::max(worst, relative(result.groups.at(4, Quantity::incident_upper, band)));
    }
    const RoundErrors groups = run.errors(run.asked(TargetScope::groups, "incident_upper")).round;
    EXPECT_DOUBLE_EQ(groups.worst, worst);
    const RoundErrors sunlit = run.errors(run.asked(TargetScope::total, "sunlit_fraction")).round;
    EXPECT_DOUBLE_EQ(sunlit.worst, relative(result.groups.sunlit_fraction[0]));
}

TEST(Question, OfOrgansLeavesOutSensorsTheGroundAndWhatIsNotMeasured) {
    const Traced run(small_spec());
    const auto asked = asked_light(run.scene, run.asked(TargetScope::organs));
    ASSERT_EQ(asked.size(), 1U);
    EXPECT_EQ(asked[0].organs, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
    const auto both = asked_light(run.scene, run.asked(TargetScope::automatic));
    ASSERT_EQ(both.size(), 2U);
    EXPECT_EQ(both[0].organs, asked[0].organs);
    EXPECT_EQ(both[1].organs, (std::vector<std::uint32_t>{kSensor}));
    EXPECT_FALSE(both[1].quantity.parts.is_absorbed);
    EXPECT_EQ(asked_light(run.scene, run.asked(TargetScope::sensors))[0].organs, both[1].organs);
    EXPECT_EQ(asked_light(run.scene, run.asked(TargetScope::automatic, "absorbed_flux")).size(), 1U)
        << "sensors absorb nothing";
}

TEST(Question, OfOrgansAndSensorsIsAnsweredByTheWorseOfBoth) {
    const Traced run(small_spec());
    const ErrorsSoFar organs = run.errors(run.asked(TargetScope::organs));
    const ErrorsSoFar sensors = run.errors(run.asked(TargetScope::sensors));
    const ErrorsSoFar both = run.errors(run.asked(TargetScope::automatic));
    EXPECT_EQ(
        both.round.fraction_at_target,
        std::min(organs.round.fraction_at_target, sensors.round.fraction_at_target));
    EXPECT_EQ(both.ratio_to_target, std::max(organs.ratio_to_target, sensors.ratio_to_target));
    EXPECT_GT(sensors.ratio_to_target, 0);
}

/// The ratio is 1 where the fraction of the target is just reached.
TEST(Question, KnowsHowFarItsTargetIs) {
    const Traced run(small_spec());
    const EvaluationSpec asked = run.asked(TargetScope::organs);
    const ErrorsSoFar far = run.errors(asked, .001);
    EXPECT_LT(far.round.fraction_at_target, .5);
    ASSERT_GT(far.ratio_to_target, 1);
    const double reached = .001 * far.ratio_to_target * (1 + 1e-12);
    EXPECT_GE(run.errors(asked, reached).round.fraction_at_target, .5);
    EXPECT_NEAR(run.errors(asked, reached).ratio_to_target, 1, 1e-9);
    EXPECT_EQ(run.errors(asked, 0).round.fraction_at_target, 0);
    EXPECT_EQ(run.errors(asked, 0).ratio_to_target, INFINITY);
}

TEST(Question, OfAScenesOnlyGroundIsAboutTheGround) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("soil", .2, 0));
    GroundSpec soil = ground("soil");
    soil.extent = {{0, 0, 1, 1}};
    builder.set_ground(soil);
    const auto asked = asked_light(std::move(builder).build(), {});
    ASSERT_EQ(asked.size(), 1U);
    EXPECT_EQ(asked[0].sets(), 1U);
}

TEST(Question, OfSunlitFractionsIsAnsweredWhereNoSunShines) {
    const Traced run(small_spec(), {sky({1, 1})});
    const ErrorsSoFar errors = run.errors(run.asked(TargetScope::organs, "sunlit_fraction"));
    EXPECT_EQ(errors.round.fraction_at_target, 1);
    EXPECT_EQ(errors.ratio_to_target, 0);
}

/// Values of an organ's absorbed flux in each replicate, each evaluated alone.
std::vector<double> values_of(const Traced& run, std::size_t organ, std::size_t band) {
    std::vector<double> values;
    for (std::size_t r = 0; r < run.sums->replicates.size(); ++r) {
        SumData one = *run.sums;
        one.replicates = {run.sums->replicates[r]};
        values.push_back(evaluate(Sums(std::move(one)), run.scene, {})
                             .at(organ, Quantity::absorbed_flux, band)
                             .mean);
    }
    return values;
}

TEST(PooledError, IsTheRootMeanSquareErrorOverTheMean) {
    const Traced run(small_spec());
    double worst = 0;
    for (const std::size_t band : {0U, 1U}) {
        double squares = 0, light = 0;
        for (std::size_t i = 0; i < kLeaves; ++i) {
            const std::vector<double> values = values_of(run, i, band);
            const double mean = mean_of(values);
            for (const double x : values) {
                squares += (x - mean) * (x - mean) / (8 * 7);
            }
            light += mean;
        }
        worst = std::max(worst, std::sqrt(squares / kLeaves) / (light / kLeaves));
    }
    const EvaluationSpec asked = run.asked(TargetScope::organs);
    EXPECT_NEAR(pooled_error(run.sums, run.scene, asked), worst, 1e-12);
    EXPECT_GT(worst, 1e-4);
    EXPECT_GE(pooled_error(run.sums, run.scene, run.asked(TargetScope::automatic)), worst - 1e-12);
    EXPECT_LT(pooled_error(run.sums, run.scene, run.asked(TargetScope::total)), worst);
    EvaluationSpec threads = asked;
    threads.threads = 3;
    EXPECT_EQ(pooled_error(run.sums, run.scene, threads), pooled_error(run.sums, run.scene, asked));
}

TEST(PooledError, IgnoresBandsWithoutEmissionAndIsInfiniteWithoutLight) {
    const Traced one_band(small_spec(), {sky({1, 0})});
    const EvaluationSpec asked = one_band.asked(TargetScope::organs);
    const double error = pooled_error(one_band.sums, one_band.scene, asked);
    EXPECT_TRUE(std::isfinite(error) && error > 0) << error;
    EXPECT_EQ(
        pooled_error(
            one_band.sums, one_band.scene, one_band.asked(TargetScope::organs, "auto", {"b1"})),
        INFINITY);
}

}  // namespace
}  // namespace quasimc::test

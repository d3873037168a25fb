// Sums of whole runs as a value: added, saved, evaluated.

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "results/evaluate.h"
#include "run/simulator.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

Scene few_leaves(double rho = .3) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", rho, .2, 2));
    add_leaves(builder, random_leaves(12, .4, 1, 5));
    return std::move(builder).build();
}

const Sources& two_lights() {
    static const Sources kSources{sun(30, {2, 1}), sky({1, 3})};
    return kSources;
}

RunSpec small_spec(Method method) {
    RunSpec spec = spec_of(method, 1024);
    spec.replicates = 4;
    return spec;
}

void expect_equal(const Result& a, const Result& b) {
    ASSERT_EQ(a.values.size(), b.values.size());
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        EXPECT_EQ(a.values[i].mean, b.values[i].mean) << i;
        EXPECT_EQ(a.values[i].ci95_high, b.values[i].ci95_high) << i;
    }
    EXPECT_EQ(a.budget[1].escaped.mean, b.budget[1].escaped.mean);
    EXPECT_EQ(a.rays, b.rays);
    EXPECT_EQ(a.paths, b.paths);
}

class RunSums : public ::testing::TestWithParam<Method> {};

TEST_P(RunSums, SayWhatTheRunSays) {
    const RunSpec spec = small_spec(GetParam());
    const Scene scene = few_leaves();
    expect_equal(
        evaluate(Simulator().sums(scene, two_lights(), spec), scene, {.sources = two_lights()}),
        run(scene, two_lights(), spec));
}

/// More organs than are evaluated before their sums are released.
TEST(GivenSums, GiveTheSameResultAsRetainedOnes) {
    constexpr std::size_t kLeaves = 33'000;
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .3, .2, 2));
    add_leaves(builder, random_leaves(kLeaves, .01, 1, 5));
    const Scene scene = std::move(builder).build();
    const EvaluationSpec asked{
        .ratios = {{0, 1}}, .groups = {.layers = 3}, .sources = two_lights(), .threads = 2};
    Sums sums = Simulator().sums(scene, two_lights(), small_spec(Method::light_tracing));
    const Result kept = evaluate(std::as_const(sums), scene, asked);
    const Result given = evaluate(std::move(sums), scene, asked);
    ASSERT_EQ(kept.organs(), kLeaves);
    expect_equal(given, kept);
    ASSERT_EQ(given.sunlit_fraction.size(), kLeaves);
    ASSERT_EQ(given.ratio_values.size(), kLeaves);
    for (std::size_t i = 0; i < kLeaves; ++i) {
        EXPECT_EQ(given.sunlit_fraction[i].ci95_high, kept.sunlit_fraction[i].ci95_high) << i;
        const double low = kept.ratio(i, 0).ci95_low;  // NaN without contributions
        EXPECT_TRUE(given.ratio(i, 0).ci95_low == low || std::isnan(low)) << i;
    }
    ASSERT_EQ(given.groups.values.size(), kept.groups.values.size());
    for (std::size_t i = 0; i < kept.groups.values.size(); ++i) {
        EXPECT_EQ(given.groups.values[i].ci95_high, kept.groups.values[i].ci95_high) << i;
    }
    EXPECT_EQ(
        given.budget[0].absorbed_by_organs.ci95_high, kept.budget[0].absorbed_by_organs.ci95_high);
}

TEST_P(RunSums, OfRoundsAddUpToThoseOfTheWholeRun) {
    RunSpec spec = small_spec(GetParam());
    const Scene scene = few_leaves();
    Simulator simulator;
    const Sums second = simulator.sums(scene, two_lights(), spec, spec.paths);
    Sums sums = load_sums(save_sums(simulator.sums(scene, two_lights(), spec)));
    sums += second;
    spec.max_paths = 2 * spec.paths;  // run() does these two rounds
    expect_equal(evaluate(sums, scene, {.sources = two_lights()}), run(scene, two_lights(), spec));
}

TEST_P(RunSums, OfAnotherRunAreRefused) {
    const RunSpec spec = small_spec(GetParam());
    const Scene scene = few_leaves();
    Simulator simulator;
    Sums sums = simulator.sums(scene, two_lights(), spec);
    RunSpec other_seed = spec;
    other_seed.seed = 99;
    EXPECT_THROW(
        sums += simulator.sums(scene, two_lights(), other_seed, spec.paths), std::invalid_argument);
    EXPECT_THROW(
        sums += simulator.sums(few_leaves(.31), two_lights(), spec, spec.paths),
        std::invalid_argument);
    EXPECT_THROW(
        sums += simulator.sums(scene, {sun(31, {2, 1}), sky({1, 3})}, spec, spec.paths),
        std::invalid_argument);
    RunSpec more_threads = spec;
    more_threads.threads = 3;
    EXPECT_NO_THROW(sums += simulator.sums(scene, two_lights(), more_threads, spec.paths));
}

TEST_P(RunSums, OfPartOfARoundAreRefused) {
    const RunSpec spec = small_spec(GetParam());
    EXPECT_THROW(
        static_cast<void>(Simulator().sums(few_leaves(), two_lights(), spec, 100)), InputError);
}

INSTANTIATE_TEST_SUITE_P(
    Of,
    RunSums,
    ::testing::Values(Method::light_tracing, Method::first_hits, Method::from_organs),
    name_of);

}  // namespace
}  // namespace quasimc::test

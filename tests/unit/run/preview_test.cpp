// A preview of a run equals the result of a shorter run, and does not change the run.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "quasimc/run.h"
#include "statistical/scenes.h"
#include "support/listening.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

bool are_same(const Result& a, const Result& b) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    return std::equal(
        a.values.begin(), a.values.end(), b.values.begin(), b.values.end(),
        [&](const Estimate& x, const Estimate& y) {
            return bits(x.mean) == bits(y.mean) && bits(x.ci95_low) == bits(y.ci95_low) &&
                   bits(x.standard_error) == bits(y.standard_error);
        });
}

Scene make_leaves() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .4, .2));
    add_leaves(builder, random_leaves(200, .2, 1, 3));
    return std::move(builder).build();
}

/// Stores the result of every pause with a new one, and of every round but the last.
class PreviewListener final : public RunListener {
  public:
    std::vector<Result> seen;

    [[nodiscard]] bool wants_pause() override { return true; }
    void on_pause(const RunSoFar& run) override {
        EXPECT_EQ(run.time_step(), 0U);
        if (run.replicates() > 1 && run.replicates() > replicates_) {
            replicates_ = run.replicates();
            seen.push_back(run.result());
        }
    }
    void on_round(const RunSoFar& run) override {
        EXPECT_EQ(run.replicates(), run.result().replicates);
        seen.push_back(run.result());
    }

  private:
    std::size_t replicates_ = 0;  // of the last pause
};

class PreviewOfMethods : public ::testing::TestWithParam<Method> {
  protected:
    /// The result of a run with previews, which go to seen_.
    Result run_seen(const RunSpec& spec) {
        PreviewListener watching;
        const Result result = run(scene_, sources_, spec, {.listeners = {&watching}});
        seen_ = std::move(watching.seen);
        return result;
    }
    [[nodiscard]] RunSpec make_spec(std::uint64_t paths) const {
        RunSpec spec = spec_of(GetParam(), paths);
        spec.threads = 3;
        return spec;
    }

    Scene scene_ = make_leaves();
    Sources sources_{sun(30, {1}), sky({.5})};
    std::vector<Result> seen_;
};

TEST_P(PreviewOfMethods, OfReplicatesIsTheResultOfSoManyReplicates) {
    RunSpec spec = make_spec(1U << 12U);
    const Result result = run_seen(spec);
    EXPECT_TRUE(are_same(result, run(scene_, sources_, spec)));
    ASSERT_FALSE(seen_.empty());
    for (const Result& seen : seen_) {
        EXPECT_GE(seen.replicates, 2U);
        EXPECT_LT(seen.replicates, kReplicates);
        EXPECT_EQ(seen.chosen.method, GetParam());
        spec.replicates = seen.replicates;
        EXPECT_TRUE(are_same(seen, run(scene_, sources_, spec))) << seen.replicates;
    }
}

TEST_P(PreviewOfMethods, OfRoundsIsTheResultOfSoManyPaths) {
    RunSpec spec = make_spec(256);
    spec.replicates = 2;  // none is complete before the round is
    spec.max_paths = 2048;
    const Result result = run_seen(spec);
    EXPECT_TRUE(are_same(result, run(scene_, sources_, spec)));
    EXPECT_EQ(result.paths, 2048U);
    ASSERT_FALSE(seen_.empty());
    for (const Result& seen : seen_) {
        EXPECT_LT(seen.paths, result.paths);
        spec.max_paths = seen.paths;
        EXPECT_TRUE(are_same(seen, run(scene_, sources_, spec))) << seen.paths;
    }
}

INSTANTIATE_TEST_SUITE_P(
    AllMethods,
    PreviewOfMethods,
    ::testing::Values(
        Method::light_tracing, Method::first_hits, Method::from_organs, Method::ray_bundles));

/// Stores the previews of a series, with the time steps.
class SeriesPreviewListener final : public RunListener {
  public:
    std::vector<std::size_t> rounds, last_rounds;  ///< their time steps
    std::vector<Result> seen;                      ///< of rounds

    void on_round(const RunSoFar& run) override {
        rounds.push_back(run.time_step());
        seen.push_back(run.result());
    }
    void on_last_round(const RunSoFar& run) override { last_rounds.push_back(run.time_step()); }
};

TEST(Preview, HasTheTimeStepOfASeries) {
    const Scene scene = make_leaves();
    std::vector<TimeStep> times(2);
    times[0] = {.name = "early", .sources = {sun(30, {1})}, .directional_key = "low sun"};
    times[1] = {.name = "late", .sources = {sun(60, {1})}, .directional_key = "high sun"};
    RunSpec spec = spec_of(Method::light_tracing, 256);
    std::vector<Result> of_one_round;
    Listening listening;
    listening.time_step = [&](std::size_t, const Result& result, std::size_t) {
        of_one_round.push_back(result);
    };
    static_cast<void>(run_series(scene, times, spec, {.listeners = {&listening}}));
    spec.max_paths = 512;
    SeriesPreviewListener watching;
    static_cast<void>(run_series(scene, times, spec, {.listeners = {&watching}}));
    EXPECT_EQ(watching.rounds, (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(watching.last_rounds, (std::vector<std::size_t>{0, 1}));
    ASSERT_EQ(of_one_round.size(), 2U);
    for (std::size_t i = 0; i < watching.rounds.size(); ++i) {
        EXPECT_TRUE(are_same(watching.seen[i], of_one_round.at(watching.rounds[i]))) << i;
    }
}

/// Asks for pauses, or for none.
class Pausing final : public RunListener {
  public:
    explicit Pausing(bool wants) : wants_(wants) {}
    int pauses = 0, last_rounds = 0;

    [[nodiscard]] bool wants_pause() override { return wants_; }
    void on_pause(const RunSoFar& /*run*/) override { ++pauses; }
    void on_last_round(const RunSoFar& /*run*/) override { ++last_rounds; }

  private:
    bool wants_;
};

TEST(Listeners, HearOfThePausesThatTheyWantAlone) {
    Pausing wants(true), wants_none(false);
    static_cast<void>(
        run(make_leaves(), {sun(30, {1})}, spec_of(Method::first_hits, 1U << 12U),
            {.listeners = {&wants_none, &wants}}));
    EXPECT_GT(wants.pauses, 0);
    EXPECT_EQ(wants_none.pauses, 0);
    EXPECT_EQ(wants.last_rounds, 1);
    EXPECT_EQ(wants_none.last_rounds, 1);
}

}  // namespace
}  // namespace quasimc::test

// Runs that end early: on request, or by a time limit.

#include <algorithm>
#include <atomic>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "light/models/source.h"
#include "run/simulator.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// A uniform sky that requests a stop at a given sample.
class StoppingSky final : public SourceModel {
  public:
    StoppingSky(std::stop_source& source, std::uint64_t at)
        : SourceModel("stopping", {1}, kSkyTraits, 1),
          sky_(make_uniform_sky("sky", {1})),
          source_(source),
          at_(at) {}
    [[nodiscard]] ModelParameters parameters() const override {
        return model_of(*sky_).parameters();
    }
    [[nodiscard]] std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const override {
        return model_of(*sky_).make_sampler_in(projection);
    }
    [[nodiscard]] Illumination illuminate(const Vec3& point, double u0, double u1) const override {
        if (++samples_ == at_) {
            source_.request_stop();
        }
        return model_of(*sky_).illuminate(point, u0, u1);
    }
    [[nodiscard]] double radiance(const Vec3& to_light) const override {
        return model_of(*sky_).radiance(to_light);
    }
    [[nodiscard]] std::uint64_t samples() const { return samples_; }

  private:
    std::shared_ptr<const Source> sky_;
    std::stop_source& source_;
    std::uint64_t at_;
    mutable std::atomic<std::uint64_t> samples_{0};
};

/// Rounds of 256 paths and more, from organs.
RunSpec run_in_rounds(std::uint64_t most) {
    RunSpec spec = spec_of(Method::from_organs, 256);
    spec.max_paths = most;
    return spec;
}

bool same_values(const Result& a, const Result& b) {
    return std::equal(
        a.values.begin(), a.values.end(), b.values.begin(), b.values.end(),
        [](const Estimate& x, const Estimate& y) {
            return x.mean == y.mean && x.ci95_low == y.ci95_low && x.ci95_high == y.ci95_high;
        });
}

TEST(StoppedRun, IsThatOfTheRoundsThatWereComplete) {
    std::stop_source never;
    const auto counting = std::make_shared<StoppingSky>(never, 0);
    const Result of_two_rounds = run(leaf_over_ground(), {counting}, run_in_rounds(512));
    ASSERT_EQ(of_two_rounds.paths, 512U);
    // In the middle of the third.
    std::stop_source source;
    const auto stopping = std::make_shared<StoppingSky>(source, counting->samples() * 3 / 2);
    const Result stopped =
        run(leaf_over_ground(), {stopping}, run_in_rounds(1U << 20U),
            RunControl{.stop = source.get_token()});
    EXPECT_EQ(stopped.stop, StopReason::interrupted);
    EXPECT_EQ(stopped.paths, 512U);
    EXPECT_EQ(stopped.rays, of_two_rounds.rays);
    EXPECT_TRUE(same_values(stopped, of_two_rounds));
}

TEST(StoppedRun, OfNoCompleteRoundHasNoResult) {
    std::stop_source source;
    const auto sky = std::make_shared<StoppingSky>(source, 100);
    Simulator simulator;
    try {
        (void)simulator.run(
            leaf_over_ground(), {sky}, run_in_rounds(0), RunControl{.stop = source.get_token()});
        ADD_FAILURE() << "not stopped";
    } catch (const Stopped& stopped) {
        EXPECT_EQ(stopped.why(), StopReason::interrupted);
    }
    const std::uint64_t samples = sky->samples();
    EXPECT_LT(samples, 100U + 2 * kReplicates) << "at most one more point is computed";
    // The simulator still works.
    const Result again = simulator.run(leaf_over_ground(), {sky}, run_in_rounds(0));
    EXPECT_TRUE(same_values(again, run(leaf_over_ground(), {sky}, run_in_rounds(0))));
}

/// A stop within the first round yields a few paths, if there is time for them, as in a series.
TEST(StoppedRun, OfNoCompleteRoundIsThatOfAFewPathsIfThereIsTime) {
    std::stop_source source;
    const auto sky = std::make_shared<StoppingSky>(source, 5000);
    RunSpec spec = spec_of(Method::from_organs, 1U << 16U);
    Simulator simulator;
    const Result few = SimulatorAccess::state(simulator).run(
        leaf_over_ground(), {sky}, spec, {.stop = source.get_token()},
        {.seconds_after_stop = 1000});
    EXPECT_EQ(few.stop, StopReason::interrupted);
    EXPECT_EQ(few.paths, 256U);
    EXPECT_TRUE(same_values(few, run(leaf_over_ground(), {sky}, run_in_rounds(0))))
        << "as if no more had been asked for";
}

/// A closed box without absorption, with a lamp in it: no path ever ends.
Scene make_white_box() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("white", 1, 0));
    const std::vector<Triangle> floor = floor_of(0, 1, 0, 1, 0);
    std::vector<Triangle> walls = floor;
    for (const Triangle& t : floor_of(0, 1, 0, 1, 1)) {
        walls.push_back(t);
    }
    for (const double at : {0., 1.}) {
        for (const auto& [a, b, c] : floor) {
            walls.push_back({Vec3{at, a.x, a.y}, Vec3{at, b.x, b.y}, Vec3{at, c.x, c.y}});
            walls.push_back({Vec3{a.x, at, a.y}, Vec3{b.x, at, b.y}, Vec3{c.x, at, c.y}});
        }
    }
    builder.add_organ(organ("box", "white", std::move(walls)));
    return std::move(builder).build();
}

class WhiteBox : public BothWays {};

TEST_P(WhiteBox, IsLeftWhenTheTimeIsUp) {
    RunSpec spec = spec_of(GetParam(), 256);
    spec.max_seconds = .05;
    LampSpec lamp;
    lamp.name = "lamp";
    lamp.position = {.5, .4, .6};
    lamp.flux = {1};
    Simulator simulator;
    try {
        (void)simulator.run(
            make_white_box(), {make_lamp(lamp)}, spec,
            RunControl{.deadline = Deadline::after(.05, .05)});
        ADD_FAILURE() << "there is no end to it";
    } catch (const Stopped& stopped) {
        EXPECT_EQ(stopped.why(), StopReason::time_limit);
        EXPECT_NE(std::string(stopped.what()).find("max_depth"), std::string::npos);
    }
}

class TimeLimit : public BothWays {};

TEST_P(TimeLimit, ThatIsLongChangesNoBit) {
    RunSpec spec = spec_of(GetParam(), 2048);
    const Result free = run(leaf_over_ground(), {sun(20, {1}), sky({1})}, spec);
    spec.max_seconds = 1000;
    const Result limited = run(leaf_over_ground(), {sun(20, {1}), sky({1})}, spec);
    EXPECT_EQ(limited.stop, StopReason::finished);
    EXPECT_EQ(limited.paths, free.paths);
    EXPECT_TRUE(same_values(free, limited));
}

TEST_P(TimeLimit, EndsAHugeRunWithAResult) {
    RunSpec spec = spec_of(GetParam(), std::uint64_t{1} << 30U);
    spec.max_seconds = 2;  // for the first pilot round, under a sanitizer too
    const Result result = run(leaf_over_ground(), {sun(20, {1}), sky({1})}, spec);
    EXPECT_EQ(result.stop, StopReason::time_limit);
    EXPECT_GE(result.paths, 256U);
    EXPECT_LT(result.paths, spec.paths);
    // The result is that of as many paths without a limit.
    const Estimate& absorbed = result.at(0, Quantity::absorbed_flux, 0);
    EXPECT_GT(absorbed.mean, 0);
    EXPECT_GT(absorbed.standard_error, 0);
}

/// Pilot rounds cost only time.
TEST_P(TimeLimit, OfNoneChangesNoBitOfAHugeRunThatMayBeStopped) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("leaf", "black", floor_of(0, 1, 0, 1, .5)));
    const Scene scene = std::move(builder).build();
    RunSpec spec = spec_of(GetParam(), std::uint64_t{1} << 22U);
    spec.replicates = 2;
    const std::stop_source never;
    EXPECT_TRUE(same_values(
        run(scene, {sun(20, {1})}, spec),
        run(scene, {sun(20, {1})}, spec, RunControl{.stop = never.get_token()})));
}

QUASIMC_BOTH_WAYS(WhiteBox);
QUASIMC_BOTH_WAYS(TimeLimit);

}  // namespace
}  // namespace quasimc::test

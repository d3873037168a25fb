#include "run/simulator.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

Scene make_two_leaves(double height, double rho = .4) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", rho, .2));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, height)));
    builder.add_organ(organ("lower leaf", "leaf", floor_of(.5, 1.5, 0, 1, 0)));
    return std::move(builder).build();
}

RunSpec short_run() {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1024;
    spec.replicates = 2;
    return spec;
}

bool same_bits(const Result& a, const Result& b) {
    return std::equal(
        a.values.begin(), a.values.end(), b.values.begin(), b.values.end(),
        [](const Estimate& x, const Estimate& y) {
            return std::bit_cast<std::uint64_t>(x.mean) == std::bit_cast<std::uint64_t>(y.mean) &&
                   std::bit_cast<std::uint64_t>(x.standard_error) ==
                       std::bit_cast<std::uint64_t>(y.standard_error);
        });
}

class SimulatorTest : public ::testing::Test {
  protected:
    Result run(const Scene& scene, const RunSpec& spec) {
        return simulator_.run(scene, sources_, spec);
    }
    Sources sources_{make_uniform_sky("sky", {1})};
    Simulator simulator_;
};

TEST_F(SimulatorTest, GivesTheBitsOfARunOnItsOwn) {
    const Scene scene = make_two_leaves(.5);
    RunSpec spec = short_run();
    for (const char* const sampler : {"sobol", "korobov", "sobol"}) {
        spec.sampler = sampler;
        ++spec.seed;
        EXPECT_TRUE(same_bits(run(scene, spec), quasimc::run(scene, sources_, spec))) << sampler;
    }
}

TEST_F(SimulatorTest, BuildsOnceForTheSameGeometry) {
    const Scene scene = make_two_leaves(.5);
    static_cast<void>(run(scene, short_run()));
    static_cast<void>(run(scene, short_run()));
    EXPECT_EQ(simulator_.builds(), 1U);
    // Another scene with the same triangles and other optics.
    const Scene paler = make_two_leaves(.5, .6);
    const Result result = run(paler, short_run());
    EXPECT_EQ(simulator_.builds(), 1U);
    EXPECT_TRUE(same_bits(result, quasimc::run(paler, sources_, short_run())));
}

TEST_F(SimulatorTest, BuildsAnewForOtherGeometry) {
    static_cast<void>(run(make_two_leaves(.5), short_run()));
    const Scene higher = make_two_leaves(.6);
    EXPECT_TRUE(same_bits(run(higher, short_run()), quasimc::run(higher, sources_, short_run())));
    EXPECT_EQ(simulator_.builds(), 2U);
    RunSpec spec = short_run();
    spec.accelerator = Accelerator::brute_force;
    static_cast<void>(run(higher, spec));
    EXPECT_EQ(simulator_.builds(), 3U);
}

TEST_F(SimulatorTest, BuildsAnewAfterTheLastRunOfAScene) {
    const Scene scene = make_two_leaves(.5);
    const Result result = std::move(simulator_).run(scene, sources_, short_run());
    EXPECT_EQ(simulator_.builds(), 1U);
    EXPECT_TRUE(same_bits(run(scene, short_run()), result));
    EXPECT_EQ(simulator_.builds(), 2U);
}

TEST_F(SimulatorTest, SurvivesASceneThatIsGone) {
    for (const double height : {.5, .6, .5}) {
        const Result result = run(make_two_leaves(height), short_run());
        EXPECT_TRUE(
            same_bits(result, quasimc::run(make_two_leaves(height), sources_, short_run())));
    }
    EXPECT_EQ(simulator_.builds(), 3U);
}

/// Runs of a plant simulator, step after step.
TEST_F(SimulatorTest, GivesAGrowingPlantTheSameLightOnAnyNumberOfThreads) {
    Simulator of_one_thread;
    for (const std::size_t leaves : {1U, 30U, 200U, 1000U}) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .4, .2));
        add_leaves(builder, random_leaves(leaves, .2, 1, 3));
        const Scene plant = std::move(builder).build();
        RunSpec spec = short_run();
        spec.threads = 1;
        const Result by_one = of_one_thread.run(plant, sources_, spec);
        spec.threads = 4;
        EXPECT_TRUE(same_bits(run(plant, spec), by_one)) << leaves;
    }
}

TEST_F(SimulatorTest, GivesSumsThatSayTheSameOnceSavedAndLoaded) {
    const Scene scene = make_two_leaves(.5);
    RunSpec spec = short_run();
    const Result direct = quasimc::run(scene, sources_, spec);
    const Sums sums = load_sums(save_sums(simulator_.sums(scene, sources_, spec)));
    const Result result = evaluate_run(sums, scene, spec, sources_);
    EXPECT_TRUE(same_bits(result, direct));
    EXPECT_EQ(result.paths, direct.paths);
    EXPECT_EQ(result.rays, direct.rays);

    ++spec.seed;
    const Sums others = simulator_.sums(scene, sources_, spec);
    EXPECT_FALSE(same_bits(evaluate_run(others, scene, spec), direct));
}

TEST_F(SimulatorTest, RefusesABadSpecificationAndGoesOn) {
    const Scene scene = make_two_leaves(.5);
    RunSpec bad = short_run();
    bad.sampler = "dice";
    EXPECT_THROW(static_cast<void>(run(scene, bad)), InputError);
    EXPECT_TRUE(same_bits(run(scene, short_run()), quasimc::run(scene, sources_, short_run())));
}

}  // namespace
}  // namespace quasimc::test

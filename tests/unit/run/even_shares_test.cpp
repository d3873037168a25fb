// Points on organs are divided evenly: among lights, and over the uncovered area. Replicates whose
// numbers of points differ by at most one, and rarely, do not show how often they differ.

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "base/angles.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

RunSpec few_points(const std::string& sampler) {
    RunSpec spec;
    spec.method = Method::from_organs;
    spec.sampler = sampler;
    spec.threads = 1;
    return spec;
}

class EvenShares : public testing::TestWithParam<std::string> {};

TEST_P(EvenShares, AnUnshadedLeafKnowsTheLightOfSeveralSuns) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("leaf", "black", floor_of(0, 1, 0, 1, 0)));
    const Scene scene = std::move(builder).build();
    const Sources suns{sun(20, {1}), sun(87, {.3}), sun(60, {.07})};
    double expected = 0;
    for (const auto& [zenith, facing] : {std::pair{20, 1.}, {87, .3}, {60, .07}}) {
        expected += facing * std::cos(kRadians * zenith);
    }
    for (const std::uint64_t paths : {64, 256, 4096}) {
        RunSpec spec = few_points(GetParam());
        spec.paths = paths;
        const Result result = run(scene, suns, spec);
        EXPECT_NEAR(result.at(0, Quantity::incident_direct, 0).mean, expected, 1e-6) << paths;
        EXPECT_NEAR(result.sunlit_fraction[0].mean, 1, 1e-6) << paths;
    }
}

TEST_P(EvenShares, ALeafThatIsPartlyCoveredKnowsHowMuchIsOpen) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("first", "black", floor_of(0, .87, -1, 2, 0)));
    builder.add_organ(organ("second", "black", floor_of(0, 1, 0, 1, 0)));
    const Scene scene = std::move(builder).build();
    for (const std::uint64_t paths : {32, 256}) {
        RunSpec spec = few_points(GetParam());
        spec.paths = paths;
        const Result result = run(scene, {sun(0, {1})}, spec);
        EXPECT_NEAR(result.sunlit_fraction[1].mean, .13, 1e-6) << paths;
        EXPECT_NEAR(result.at(1, Quantity::incident_upper, 0).mean, .13, 1e-6) << paths;
    }
}

INSTANTIATE_TEST_SUITE_P(PointSets, EvenShares, testing::Values("sobol", "korobov"));

}  // namespace
}  // namespace quasimc::test

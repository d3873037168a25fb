// Budgets so large that 64-bit sums of fixed point would wrap around.

#include <gtest/gtest.h>

#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// One black leaf, flat under the sun: all that falls on it is absorbed, without any error.
Result light_of_one_leaf(Method method, std::uint64_t paths) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", 0, 0));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, .5)));
    const Scene scene = std::move(builder).build();
    RunSpec spec = spec_of(method, paths);
    spec.replicates = 2;
    spec.threads = 2;
    spec.max_depth = 1;
    return run(scene, {sun(0, {.5})}, spec);
}

struct Budget {
    Method method;
    std::uint64_t paths;
};

class LargeBudgets : public ::testing::TestWithParam<Budget> {};

/// The cross-section of a beam is larger than the scene by a millionth (holds()).
TEST_P(LargeBudgets, SumWhatFallsOnALeaf) {
    const Result result = light_of_one_leaf(GetParam().method, GetParam().paths);
    EXPECT_EQ(result.paths, GetParam().paths);
    EXPECT_NEAR(result.at(0, Quantity::absorbed_flux, 0).mean, .5, 1e-5);
    EXPECT_NEAR(result.at(0, Quantity::incident_upper, 0).mean, .5, 1e-5);
    EXPECT_NEAR(result.sunlit_fraction[0].mean, 1, 1e-5);
    EXPECT_LT(result.budget[0].closure_error, 1e-9);
}

std::string name_of_budget(const ::testing::TestParamInfo<Budget>& info) {
    return name_of({info.param.method, info.index});
}

// From the organs a bin of 63 bits would be full after 2^23 points of one organ.
INSTANTIATE_TEST_SUITE_P(
    Ways,
    LargeBudgets,
    ::testing::Values(
        Budget{Method::light_tracing, 1 << 24},
        Budget{Method::first_hits, 1 << 24},
        Budget{Method::from_organs, 1 << 24}),
    name_of_budget);

INSTANTIATE_TEST_SUITE_P(
    Long,
    LargeBudgets,
    ::testing::Values(
        Budget{Method::light_tracing, 1 << 30},
        Budget{Method::first_hits, 1 << 30},
        Budget{Method::from_organs, 1 << 30}),
    name_of_budget);

}  // namespace
}  // namespace quasimc::test

// Small stands of the five kinds of `./dev bench agreement`: every method against plain Monte Carlo
// light tracing.

#include "stands.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "statistical/comparison.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

using bench::StandKind;

constexpr std::uint32_t kLeaves = 40;
constexpr std::array kWays{Method::light_tracing, Method::from_organs, Method::first_hits};

class Stands : public ::testing::TestWithParam<StandKind> {};

Result trace_plain(const Scene& scene) {
    RunSpec spec = spec_of(Method::light_tracing, 1 << 17);
    spec.sampler = "monte_carlo";
    spec.seed = 77;
    return run(scene, bench::light_of_stands(), spec);
}

TEST_P(Stands, GetTheLightOfPlainTracing) {
    const Scene scene = bench::make_stand(GetParam(), kLeaves);
    const Result plain = trace_plain(scene);
    Comparison comparison(kWays.size() * bench::kStandKinds.size());
    for (const Method from : kWays) {
        SCOPED_TRACE(fmt::format("from {}", name_of({from, 0})));
        const Result other = run(scene, bench::light_of_stands(), spec_of(from, 1 << 14));
        EXPECT_TRUE(comparison.totals_agree(plain, other));
        EXPECT_TRUE(comparison.organs_agree(plain, other));
    }
    EXPECT_TRUE(comparison.are_sharp(.02, .3));
}

INSTANTIATE_TEST_SUITE_P(
    EveryKind, Stands, ::testing::ValuesIn(bench::kStandKinds), [](const auto& kind) {
        std::string name = bench::name_of(kind.param);
        std::replace(name.begin(), name.end(), ' ', '_');
        return name;
    });

/// A control: one leaf in ten that is a mirror on one side, or not.
TEST(StandsControl, ShinyLeavesAreNotLikeDullOnes) {
    const Result plain = trace_plain(bench::make_stand(StandKind::random_leaves, kLeaves));
    const Scene shiny = bench::make_stand(StandKind::shiny_leaves, kLeaves);
    const Result other =
        run(shiny, bench::light_of_stands(), spec_of(Method::light_tracing, 1 << 14));
    EXPECT_FALSE(Comparison(1).organs_agree(plain, other));
}

}  // namespace
}  // namespace quasimc::test

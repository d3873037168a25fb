// Coverage of intervals of auto under lamps, for few measured leaves close to them: it traces from
// the organs there, where single samples may contribute much.

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "planner/planner.h"
#include "quasimc/source.h"
#include "statistical/scenes.h"
#include "sums/statistics.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr std::size_t kMeasured = 6;

/// Leaves in a cube of side 1 over a floor; those next to its middle, where the lamp is, are
/// measured.
Scene make_lit_stand(double albedo) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .5 * albedo, .5 * albedo));
    builder.add_material(diffuse("floor", albedo, 0));
    std::vector<Triangle> leaves = random_leaves(60, .2, 1, 7);
    const auto from_middle = [](const Triangle& t) {
        return length((t[0] + t[1] + t[2]) / 3 - Vec3{.5, .5, .5});
    };
    std::sort(leaves.begin(), leaves.end(), [&](const Triangle& a, const Triangle& b) {
        return from_middle(a) < from_middle(b);
    });
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        OrganSpec leaf = organ("", "leaf", {leaves[i]});
        leaf.measured = i < kMeasured;
        builder.add_organ(leaf);
    }
    OrganSpec floor = organ("floor", "floor", floor_of(0, 1, 0, 1, -.1));
    floor.measured = false;
    builder.add_organ(floor);
    return std::move(builder).build();
}

struct Case {
    std::string name;
    Opening opening;
    Pattern pattern;
    double albedo;
    double most;  ///< upper limit of coverage: with few contributions the rule of three is
                  ///< conservative
};

constexpr Opening kPanel{.kind = Opening::Kind::rectangle, .length = .1, .width = .05};
constexpr Opening kTube{.kind = Opening::Kind::line, .length = .3};

std::vector<Case> cases() {
    return {
        {"point_among_bright_leaves", {}, isotropic_pattern(), .8, .99},
        {"panel", kPanel, cosine_pattern(), .2, .97}};
}

/// Further cases for the same methods.
std::vector<Case> further_cases() {
    return {
        {"point", {}, isotropic_pattern(), .2, .999}, {"tube", kTube, tube_pattern(), .2, .999}};
}

Sources lamp_of(const Case& one) {
    LampSpec spec;
    spec.name = "lamp";
    spec.position = {.5, .5, .5};
    spec.axes = lamp_axes({0, 0, -1}, {1, 0, 0});
    spec.opening = one.opening;
    spec.pattern = one.pattern;
    spec.flux = {1};
    return {make_lamp(std::move(spec))};
}

/// The compared values: of lit, measured leaves.
constexpr std::array kAsked{
    Quantity::absorbed_flux, Quantity::incident_upper, Quantity::incident_lower,
    Quantity::incident_scattered};

class LampCoverage : public ::testing::TestWithParam<Case> {};

TEST_P(LampCoverage, IsThatOfIntervalsWhereAutoTracesFromTheOrgans) {
    const Scene scene = make_lit_stand(GetParam().albedo);
    const Sources sources = lamp_of(GetParam());
    RunSpec pilot;
    pilot.method = Method::automatic;
    pilot.threads = 1;
    pilot.paths = 1024;
    ASSERT_EQ(plan_method(scene, sources, pilot).method, Method::from_organs);
    const Result truth = run(scene, sources, spec_of(Method::from_organs, 1 << 15));
    const Result other = run(scene, sources, spec_of(Method::light_tracing, 1 << 17));

    constexpr int kSeeds = 200;
    std::vector<double> held, widths;
    for (int seed = 1; seed <= kSeeds; ++seed) {
        pilot.seed = static_cast<std::uint64_t>(seed);
        const Result result = run(scene, sources, pilot);
        double right = 0, count = 0;
        for (std::size_t organ = 0; organ < kMeasured; ++organ) {
            const Estimate& absorbed = result.at(organ, Quantity::absorbed_flux, 0);
            widths.push_back((absorbed.ci95_high - absorbed.ci95_low) / absorbed.mean);
            for (const Quantity q : kAsked) {
                const double mean = truth.at(organ, q, 0).mean;
                const Estimate& e = result.at(organ, q, 0);
                count += mean > 0 ? 1 : 0;
                right += mean > 0 && e.ci95_low <= mean && mean <= e.ci95_high ? 1 : 0;
            }
        }
        held.push_back(right / count);
    }
    const Estimate part = estimate_mean(held);
    EXPECT_GE(part.mean, .93) << part.standard_error;
    EXPECT_LE(part.mean, GetParam().most) << part.standard_error;
    EXPECT_LE(estimate_mean(widths).mean, .2);
    RecordProperty("coverage", std::to_string(part.mean));
    for (std::size_t organ = 0; organ < kMeasured; ++organ) {
        const Estimate& a = truth.at(organ, Quantity::absorbed_flux, 0);
        const Estimate& b = other.at(organ, Quantity::absorbed_flux, 0);
        EXPECT_TRUE(agrees(
            measured(a, kReplicates), measured(b, kReplicates), .2 * b.mean,
            sidak_level(kLevel, kMeasured)));
    }
}

std::string name_of_case(const ::testing::TestParamInfo<Case>& of_case) {
    return of_case.param.name;
}

INSTANTIATE_TEST_SUITE_P(Lamps, LampCoverage, ::testing::ValuesIn(cases()), name_of_case);
INSTANTIATE_TEST_SUITE_P(Long, LampCoverage, ::testing::ValuesIn(further_cases()), name_of_case);

}  // namespace
}  // namespace quasimc::test

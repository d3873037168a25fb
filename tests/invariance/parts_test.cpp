// Taking a scene, its bands or its engine to pieces does not change the light.

#include <algorithm>
#include <array>
#include <cmath>

#include "invariance/plot.h"
#include "statistical/comparison.h"

namespace quasimc::test {
namespace {

class Parts : public BothWays {
  protected:
    [[nodiscard]] Result trace_bands(
        const std::vector<std::size_t>& bands, std::uint64_t paths, std::uint64_t seed) const {
        RunSpec spec = spec_of(GetParam(), paths);
        spec.seed = seed;
        return run(make_plot({.bands = bands}), plot_sources({.bands = bands}), spec);
    }
};

TEST_P(Parts, TheOrderOfBandsDoesNotMatter) {
    const Result abc = trace_bands({0, 1, 2}, 1 << 13, 1);
    const Result cab = trace_bands({2, 0, 1}, 1 << 13, 2);
    Comparison comparison(1);
    const Result sorted = with_bands(cab, {1, 2, 0});
    EXPECT_TRUE(comparison.totals_agree(abc, sorted));
    EXPECT_TRUE(comparison.organs_agree(abc, sorted));
    EXPECT_TRUE(comparison.are_sharp(.05, .5));
}

/// Bands that share a path push each other to and fro, but not away from the truth.
TEST_P(Parts, OnePathForAllBandsGivesTheSameAsOneForEach) {
    const Result together = trace_bands({0, 1, 2}, 1 << 13, 1);
    Comparison comparison(kPlotBands);
    for (std::size_t b = 0; b < kPlotBands; ++b) {
        const Result alone = trace_bands({b}, 1 << 13, 10 + b);
        const Result one = with_bands(together, {b});
        EXPECT_TRUE(comparison.totals_agree(one, alone));
        EXPECT_TRUE(comparison.organs_agree(one, alone));
    }
    EXPECT_TRUE(comparison.are_sharp(.05, .5));
}

/// Where roulette begins to play is a matter of cost alone.
TEST_P(Parts, TheWeightThatRoulettePlaysForDoesNotMatter) {
    const Scene scene = make_plot({});
    RunSpec spec = spec_of(GetParam(), 1 << 12);
    const Result result = run(scene, plot_sources({}), spec);
    Comparison comparison(2);
    for (const double weight : {.3, .01}) {
        spec.roulette_threshold = weight;
        ++spec.seed;
        const Result other = run(scene, plot_sources({}), spec);
        EXPECT_TRUE(comparison.totals_agree(result, other)) << weight;
        EXPECT_TRUE(comparison.organs_agree(result, other)) << weight;
        EXPECT_LE(other.budget[0].closure_error, 1e-12);
        EXPECT_NE(other.rays, result.rays);
    }
    EXPECT_TRUE(comparison.are_sharp(.1, .8));
}

TEST_P(Parts, EqualBandsAreEqualToTheLastBit) {
    const Result twice = trace_bands({1, 1}, 1 << 10, 1);
    EXPECT_TRUE(have_the_same_bits(with_bands(twice, {0, 0}), with_bands(twice, {1, 1})));
}

TEST_P(Parts, BruteForceFindsTheSameLight) {
    RunSpec spec = spec_of(GetParam(), 1 << 10);
    for (const bool periodic : {false, true}) {
        const Scene scene = make_plot({.periodic = periodic});
        spec.accelerator = Accelerator::embree;
        const Result embree = run(scene, plot_sources({}), spec);
        spec.accelerator = Accelerator::brute_force;
        const Result brute = run(scene, plot_sources({}), spec);
        EXPECT_TRUE(are_nearly_identical(embree, brute, 1e-3));
    }
}

/// Two triangles above a ground, in one organ or in two, of one material or of two.
Scene make_pair(bool in_one_organ, bool of_one_material) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("a", .3, .2));
    builder.add_material(of_one_material ? diffuse("b", .3, .2) : diffuse("b", .1, .6));
    builder.add_material(diffuse("soil", .4, 0));
    const std::vector<Triangle> leaf = floor_of(0, 1, 0, 1, .5);
    if (in_one_organ) {
        OrganSpec both = organ("both", "a", {leaf[0]});
        both.parts.push_back({"b", {leaf[1]}});
        builder.add_organ(both);
    } else {
        builder.add_organ(organ("one", "a", {leaf[0]}));
        builder.add_organ(organ("other", "b", {leaf[1]}));
    }
    GroundSpec soil = ground("soil");
    soil.extent = {{-1, -1, 2, 2}};
    builder.set_ground(soil);
    return std::move(builder).build();
}

double absorbed(const Result& result, std::size_t organ) {
    return result.at(organ, Quantity::absorbed_flux, 0).mean;
}

TEST(Organs, SplittingOneAddsUpToTheLastDigit) {
    const Sources sources{sun(30, {1}), sky({1})};
    for (const bool of_one_material : {true, false}) {
        const RunSpec spec = spec_of(Method::light_tracing, 1 << 12);
        const Result whole = run(make_pair(true, of_one_material), sources, spec);
        const Result split = run(make_pair(false, of_one_material), sources, spec);
        const double sum = absorbed(split, 0) + absorbed(split, 1);
        EXPECT_NEAR(absorbed(whole, 0), sum, 1e-12 * sum);
        EXPECT_NEAR(absorbed(whole, 1), absorbed(split, 2), 1e-12 * sum);  // the ground
    }
}

TEST(Organs, SplittingOneAddsUpSeenFromTheOrgans) {
    const Sources sources{sun(30, {1}), sky({1})};
    const RunSpec spec = spec_of(Method::from_organs, 1 << 14);
    const Result whole = run(make_pair(true, false), sources, spec);
    const Result split = run(make_pair(false, false), sources, spec);
    const Estimate& one = split.at(0, Quantity::absorbed_flux, 0);
    const Estimate& other = split.at(1, Quantity::absorbed_flux, 0);
    const Measured sum{
        one.mean + other.mean, one.standard_error + other.standard_error, kReplicates};
    EXPECT_TRUE(agrees(
        measured(whole.at(0, Quantity::absorbed_flux, 0), kReplicates), sum, .05 * sum.mean));
}

/// The same leaves, added last first: each receives the same.
TEST(Organs, MayBeAddedInAnyOrder) {
    std::array<Result, 2> results;
    for (const bool reversed : {false, true}) {
        SceneBuilder builder = make_builder(kPlotBands);
        for (const MaterialSpec& material : plot_materials({0, 1, 2})) {
            builder.add_material(material);
        }
        std::vector<Triangle> leaves = plot_leaves();
        if (reversed) {
            std::reverse(leaves.begin(), leaves.end());
        }
        for (const Triangle& leaf : leaves) {
            builder.add_organ(organ("", "leaf", {leaf}));
        }
        const Scene scene = std::move(builder).build();
        Result& result = results[reversed ? 1 : 0];
        result = run(scene, plot_sources({}), spec_of(Method::light_tracing, 1 << 13));
        if (reversed) {
            std::vector<Estimate> values;
            const std::size_t row = kQuantities * kPlotBands;
            for (std::size_t i = result.organs(); i-- > 0;) {
                const auto at = result.values.begin() + static_cast<std::ptrdiff_t>(i * row);
                values.insert(values.end(), at, at + static_cast<std::ptrdiff_t>(row));
            }
            result.values = values;
        }
    }
    EXPECT_TRUE(are_nearly_identical(results[0], results[1], 1e-3));
}

/// Turned over, with its sides exchanged, a leaf is the same leaf.
TEST_P(Parts, TurningALeafOverExchangesItsSides) {
    const auto trace_leaf = [&](bool turned) {
        MaterialSpec leaf = plot_materials({0, 1, 2})[0];
        std::vector<Triangle> triangles{plot_leaves()[3]};
        if (turned) {
            std::swap(leaf.upper, leaf.lower);
            triangles = turned_over(triangles);
        }
        SceneBuilder builder = make_builder(kPlotBands);
        builder.add_material(leaf);
        builder.add_material(plot_materials({0, 1, 2})[2]);
        builder.add_organ(organ("leaf", "leaf", triangles));
        GroundSpec soil = ground("soil");
        soil.height = -.2;
        soil.extent = {{-1, -1, 2, 2}};
        builder.set_ground(soil);
        return run(std::move(builder).build(), plot_sources({}), spec_of(GetParam(), 1 << 13));
    };
    const Result plain = trace_leaf(false);
    const Result turned = trace_leaf(true);
    for (std::size_t b = 0; b < kPlotBands; ++b) {
        const Estimate& upper = plain.at(0, Quantity::incident_upper, b);
        const Estimate& lower = plain.at(0, Quantity::incident_lower, b);
        EXPECT_TRUE(agrees(
            measured(upper, kReplicates),
            measured(turned.at(0, Quantity::incident_lower, b), kReplicates), .2 * upper.mean));
        EXPECT_TRUE(agrees(
            measured(lower, kReplicates),
            measured(turned.at(0, Quantity::incident_upper, b), kReplicates), .2 * upper.mean));
    }
}

QUASIMC_BOTH_WAYS(Parts);

}  // namespace
}  // namespace quasimc::test

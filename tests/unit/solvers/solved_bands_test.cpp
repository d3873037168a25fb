// Many bands are interpolated from few: they have the light that they have if all are solved.

#include "solvers/ray_bundles/solved_bands.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "optics/prospect.h"
#include "quasimc/result.h"
#include "samplers/balanced_numbers.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr std::size_t kBands = 80;

MaterialSpec material(const std::string& name, const std::vector<LeafOptics>& optics) {
    MaterialSpec spec = diffuse(name, 0, 0, optics.size());
    for (std::size_t b = 0; b < optics.size(); ++b) {
        spec.upper[b].reflectance = spec.lower[b].reflectance = optics[b].reflectance;
        spec.upper[b].transmittance = spec.lower[b].transmittance = optics[b].transmittance;
    }
    return spec;
}

/// A leaf in bands over 400 to 2400 nm.
MaterialSpec leaf(const std::string& name, double chlorophyll, double water) {
    std::vector<LeafOptics> optics;
    for (std::size_t b = 0; b < kBands; ++b) {
        optics.push_back(prospect(
            leaf_constants()[b * 400 / kBands], {.structure = 1.5,
                                                 .chlorophyll = chlorophyll,
                                                 .carotenoids = 10,
                                                 .water = water,
                                                 .dry_matter = .009}));
    }
    return material(name, optics);
}

/// An opaque material that becomes brighter with the wavelength.
MaterialSpec ramp(const std::string& name, double first, double last, double power) {
    std::vector<LeafOptics> optics;
    for (std::size_t b = 0; b < kBands; ++b) {
        const double at = std::pow(static_cast<double>(b) / kBands, power);
        optics.push_back({first + (last - first) * at, 0});
    }
    return material(name, optics);
}

struct BandScene {
    bool has_many_materials = false, is_periodic = false;
    std::size_t leaves = 60;
    double edge = .3;
};

/// A scene whose bands are all solved, or not. Thirty tiny triangles are black, or of random optics
/// that no band explains for another.
Scene make_scene(const BandScene& of, bool is_all_solved) {
    SceneBuilder builder = make_builder(kBands);
    builder.add_material(leaf("leaf", 40, .015));
    add_leaves(builder, random_leaves(of.leaves, of.edge, 1, 3));
    if (of.has_many_materials) {
        builder.add_material(leaf("dry", 5, .002));
        builder.add_material(ramp("stem", .05, .5, 1));
        builder.add_material(ramp("soil", .1, .35, .5));
        builder.add_organ(organ("", "dry", random_leaves(30, .3, 1, 4)));
        builder.add_organ(organ("", "stem", random_leaves(10, .2, 1, 5)));
        builder.set_ground(ground("soil"));
    }
    if (of.is_periodic) {
        builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    }
    for (std::size_t i = 0; i < kBands / 2; ++i) {
        std::vector<LeafOptics> optics(kBands);
        for (std::size_t b = 0; is_all_solved && b < kBands; ++b) {
            optics[b].reflectance = .25 + .25 * std::sin(static_cast<double>(i * b * b + b));
        }
        const std::string name = "speck" + std::to_string(i);
        builder.add_material(material(name, optics));
        const double x = .1 + .01 * static_cast<double>(i);
        builder.add_organ(
            organ("", name, {{{x, .1, 1.1}, {x + 1e-5, .1, 1.1}, {x, .1 + 1e-5, 1.1}}}));
    }
    return std::move(builder).build();
}

/// Compares a run with one whose bands are all solved, within the errors of both.
void expect_agreement(const Result& few, const Result& solved) {
    for (std::size_t b = 0; b < kBands; ++b) {
        for (std::size_t i = 0; i < few.organs() - kBands / 2; ++i) {
            const Estimate& e = few.at(i, Quantity::incident_scattered, b);
            const Estimate& truth = solved.at(i, Quantity::incident_scattered, b);
            EXPECT_GE(e.mean, 0);
            EXPECT_NEAR(
                e.mean, truth.mean, 10 * std::hypot(e.standard_error, truth.standard_error));
        }
        const BandBudget& budget = few.budget[b];
        EXPECT_LT(budget.closure_error, 1e-9);
        EXPECT_NEAR(budget.escaped.mean, solved.budget[b].escaped.mean, .01 * budget.emitted.mean);
    }
}

/// Interpolates the light of a run whose bands are all solved, and compares it with the solution
/// along the same lines.
/// @param lights  amounts, [light][band]
void expect_alike(
    const BandScene& of, const Sources& sources, const std::vector<std::vector<double>>& lights) {
    const Scene some = make_scene(of, false);
    const Scene all = make_scene(of, true);
    const SolvedBands bands(some, lights);
    ASSERT_FALSE(bands.are_all());
    EXPECT_EQ(count_solved_bands(all, sources), kBands);
    RunSpec spec = spec_of(Method::ray_bundles, 1 << 9);
    spec.replicates = 8;
    const Result solved = run(all, sources, spec);
    expect_agreement(run(some, sources, spec), solved);

    double largest = 0, squares = 0, reported = 0;
    for (std::size_t i = 0; i < solved.organs() - kBands / 2; ++i) {
        std::vector<double> light, found(kBands), above(kBands);
        for (std::size_t b = 0; b < kBands; ++b) {
            const double emitted = solved.budget[b].emitted.mean;
            light.push_back(solved.at(i, Quantity::incident_scattered, b).mean / emitted);
        }
        bands.interpolate(bands.select(light), std::vector<double>(kBands), found);
        bands.interpolate(bands.select(light), std::vector<double>(kBands, 1), above);
        for (std::size_t b = 0; b < kBands; ++b) {
            const double direct =
                solved.at(i, Quantity::incident_direct, b).mean / solved.budget[b].emitted.mean;
            const double difference = found[b] - light[b];
            largest = std::max(largest, std::abs(difference) / (light[b] + direct));
            squares += difference * difference;
            reported += std::pow(above[b] - found[b], 2);
        }
    }
    ::testing::Test::RecordProperty("solved", static_cast<int>(bands.count()));
    ::testing::Test::RecordProperty("millionths", static_cast<int>(1e6 * largest));
    EXPECT_LT(largest, 1e-3);
    EXPECT_GT(reported, squares);
    EXPECT_LT(reported, 1e4 * squares);
}

const std::vector<double> kWhite(kBands, 1);

TEST(SolvedBands, GiveTheLightOfAllBandsUnderASun) {
    expect_alike({}, {sun(35, kWhite)}, {kWhite});
}

TEST(SolvedBands, GiveTheLightOfAllBandsWithFourMaterials) {
    expect_alike({.has_many_materials = true}, {sun(35, kWhite)}, {kWhite});
}

TEST(SolvedBands, GiveTheLightOfAllBandsInAPeriodicCell) {
    expect_alike({.is_periodic = true}, {sun(35, kWhite)}, {kWhite});
}

/// Sun and sky of different colours: the light is a sum of two responses.
TEST(SolvedBands, GiveTheLightOfAllBandsUnderSunAndSky) {
    std::vector<double> red, blue;
    for (std::size_t b = 0; b < kBands; ++b) {
        red.push_back(.2 + std::sin(.2 * static_cast<double>(b)) * .1);
        blue.push_back(std::exp(-.1 * static_cast<double>(b)));
    }
    expect_alike({.is_periodic = true}, {sun(35, red), sky(blue)}, {red, blue});
}

/// A band of a light that no other band has is solved, and a dark band has no light.
TEST(SolvedBands, KeepLightsApart) {
    std::vector<double> most(kBands, 1), one(kBands), none(kBands);
    most[20] = most[30] = 0;
    one[20] = 1;
    const Scene scene = make_scene({}, false);
    const SolvedBands bands(scene, std::vector{most, one});
    EXPECT_FALSE(bands.are_all());
    std::vector<double> light(bands.count(), 1), all(kBands);
    const std::vector<double> exact(kBands);
    bands.interpolate(light, exact, all);
    EXPECT_EQ(all[20], 1);
    EXPECT_EQ(all[30], 0);
    const std::vector<double> own = bands.select(one);
    EXPECT_TRUE(std::find(own.begin(), own.end(), 1) != own.end());
}

/// Light that is a polynomial of the optics, of two materials that vary independently, is
/// interpolated within its reported error; negative light is not made up.
TEST(SolvedBands, InterpolateAPowerSeriesWithinItsError) {
    SceneBuilder builder = make_builder(200);
    std::vector<LeafOptics> a, b;
    for (std::size_t i = 0; i < 200; ++i) {
        a.push_back({.4 + .3 * std::sin(.1 * static_cast<double>(i)), 0});
        b.push_back({.4 + .3 * std::cos(.031 * static_cast<double>(i)), 0});
    }
    builder.add_material(material("a", a));
    builder.add_material(material("b", b));
    builder.add_organ(organ("", "a", random_leaves(1, .1, 1, 1)));
    builder.add_organ(organ("", "b", random_leaves(1, .1, 1, 2)));
    const SolvedBands bands(
        std::move(builder).build(), std::vector<std::vector<double>>{std::vector<double>(200, 1)});
    EXPECT_LT(bands.count(), 40U);
    std::vector<double> light;
    for (std::size_t i = 0; i < 200; ++i) {
        const double x = .3 * a[i].reflectance, y = .4 * b[i].reflectance;
        light.push_back((x + y) / (1 - x - y));
    }
    std::vector<double> all(200), above(200);
    bands.interpolate(bands.select(light), std::vector<double>(200), all);
    bands.interpolate(bands.select(light), std::vector<double>(200, 1), above);
    for (std::size_t i = 0; i < 200; ++i) {
        EXPECT_NEAR(all[i], light[i], 1e-3 * light[i]);
        EXPECT_LE(std::abs(all[i] - light[i]), above[i] - all[i] + 1e-12);
    }
}

TEST(SolvedBands, AreAllIfTheyAreFew) {
    SceneBuilder builder = make_builder(15);
    builder.add_material(diffuse("leaf", .4, .4, 15));
    add_leaves(builder, random_leaves(2, .3, 1, 3));
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(count_solved_bands(scene, {sun(0, std::vector<double>(15, 1))}), 15U);
}

TEST(SolvedBands, AreOneIfAllAreEqual) {
    SceneBuilder builder = make_builder(16);
    builder.add_material(diffuse("leaf", .4, .4, 16));
    add_leaves(builder, random_leaves(2, .3, 1, 3));
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(count_solved_bands(scene, {sun(0, std::vector<double>(16, 2))}), 1U);
}

TEST(BalancedNumbers, HaveAMeanOfZeroAndAnErrorOfOne) {
    for (const std::size_t count : {1U, 2U, 7U, 8U}) {
        const std::vector<double> numbers = balanced_numbers(count, 5);
        double squares = 0;
        for (const double x : numbers) {
            squares += x * x;
        }
        EXPECT_NEAR(std::accumulate(numbers.begin(), numbers.end(), 0.), 0, 1e-12);
        const auto n = static_cast<double>(count);
        EXPECT_NEAR(squares, count > 1 ? n * (n - 1) : 0, 1e-9);
    }
}

}  // namespace
}  // namespace quasimc::test

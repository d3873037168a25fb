// Hundreds of suns, of which each replicate picks some, against as many lines for each sun.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

enum class Extent { open, periodic };

Scene make_sunny_stand(Extent extent) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(lambertian("leaf", {.1, .5}, {.1, .2}));
    const std::vector<Triangle> leaves = random_leaves(60, .3, 1, 5);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        builder.add_organ(organ("leaf " + std::to_string(i), "leaf", {leaves[i]}));
    }
    if (extent == Extent::periodic) {
        builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    }
    return std::move(builder).build();
}

/// Suns from the horizon to the zenith and down again, dim and red when they are low.
Sources suns_of_day(int count) {
    Sources suns;
    for (int i = 0; i < count; ++i) {
        const double zenith_deg = std::abs(80 - 160 * (i + .5) / count);
        const double height = std::cos(zenith_deg * std::numbers::pi / 180);
        suns.push_back(sun(zenith_deg, {height, .3 + .7 * height}));
    }
    return suns;
}

struct ManySunsCase {
    Method method;
    Extent extent;
};

class ManySunsOfStand : public ::testing::TestWithParam<ManySunsCase> {};

TEST_P(ManySunsOfStand, GiveTheLightOfAllSuns) {
    const Scene scene = make_sunny_stand(GetParam().extent);
    const Sources suns = suns_of_day(400);
    RunSpec spec = spec_of(GetParam().method, 512);
    spec.replicates = 64;
    const Result picked = run(scene, suns, spec);
    const Result all = run(scene, suns, spec_of(Method::first_hits, 1 << 15));
    const double level = kLevel / static_cast<double>(3 * picked.organs());
    for (std::size_t i = 0; i < picked.organs(); ++i) {
        for (std::size_t band = 0; band < 2; ++band) {
            const Estimate& a = picked.at(i, Quantity::absorbed_flux, band);
            const Estimate& b = all.at(i, Quantity::absorbed_flux, band);
            EXPECT_TRUE(
                agrees(measured(a, spec.replicates), measured(b, kReplicates), .7 * b.mean, level))
                << i << ", " << band;
        }
        EXPECT_TRUE(agrees(
            measured(picked.sunlit_fraction[i], spec.replicates),
            measured(all.sunlit_fraction[i], kReplicates), .3, level))
            << i;
    }
    for (std::size_t band = 0; band < 2; ++band) {
        const BandBudget& budget = picked.budget[band];
        EXPECT_LT(budget.closure_error, 1e-6);
        EXPECT_TRUE(agrees(
            measured(budget.emitted, spec.replicates), all.budget[band].emitted.mean,
            .05 * budget.emitted.mean));
        EXPECT_TRUE(agrees(
            measured(budget.absorbed_by_organs, spec.replicates),
            measured(all.budget[band].absorbed_by_organs, kReplicates),
            .1 * budget.absorbed_by_organs.mean));
    }
    EXPECT_GT(picked.budget[1].emitted.standard_error, 0);
}

/// Four hundred suns with 512 paths, about one each.
TEST_P(ManySunsOfStand, HaveSmallErrors) {
    const Scene scene = make_sunny_stand(GetParam().extent);
    const Sources suns = suns_of_day(400);
    const Result picked = run(scene, suns, spec_of(GetParam().method, 512));
    const Result traced = run(scene, suns, spec_of(Method::light_tracing, 512));
    double error = 0;
    double error_of_paths = 0;
    for (std::size_t i = 0; i < picked.organs(); ++i) {
        error += picked.at(i, Quantity::absorbed_flux, 0).standard_error;
        error_of_paths += traced.at(i, Quantity::absorbed_flux, 0).standard_error;
    }
    EXPECT_LT(error, .7 * error_of_paths);
}

/// Suns of one colour: as much light is emitted in every replicate, to rounding.
TEST(ManySuns, OfOneColourEmitExactlyTheirLight) {
    Sources suns;
    for (int i = 0; i < 200; ++i) {
        suns.push_back(sun(.4 * i, {1, 1}));
    }
    const Scene scene = make_sunny_stand(Extent::open);
    for (const Method method : {Method::first_hits, Method::ray_bundles}) {
        const Result result = run(scene, suns, spec_of(method, 256));
        const Estimate& emitted = result.budget[0].emitted;
        EXPECT_LT(emitted.standard_error, 1e-14 * emitted.mean);
        EXPECT_LT(result.budget[0].closure_error, 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Cases,
    ManySunsOfStand,
    ::testing::Values(
        ManySunsCase{Method::first_hits, Extent::open},
        ManySunsCase{Method::first_hits, Extent::periodic},
        ManySunsCase{Method::ray_bundles, Extent::open},
        ManySunsCase{Method::ray_bundles, Extent::periodic}),
    [](const auto& one) {
        return std::string(one.param.method == Method::first_hits ? "first_hits" : "ray_bundles") +
               (one.param.extent == Extent::open ? "_open" : "_periodic");
    });

}  // namespace
}  // namespace quasimc::test

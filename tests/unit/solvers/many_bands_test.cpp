// Ray bundles know what many bands have on patches pack by pack: each band has the light that it
// has among few.

#include <vector>

#include <gtest/gtest.h>

#include "quasimc/result.h"
#include "scene/repeat_bands.h"
#include "solvers/ray_bundles/band_packs.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

TEST(BandPacks, HoldEachBandOnce) {
    for (std::size_t bands = 1; bands < 20; ++bands) {
        std::size_t next = 0;
        for (const BandPack& pack : band_packs(bands)) {
            EXPECT_EQ(pack.first, next);
            EXPECT_TRUE(1 <= pack.bands && pack.bands <= kMaxInPack);
            next += pack.bands;
        }
        EXPECT_EQ(next, bands);
    }
    EXPECT_EQ(band_packs(5).size(), 1);
    EXPECT_EQ(band_packs(7).size(), 2);
}

/// Leaves over soil, some of them crossing each other, and a sensor that lines pass.
Scene stand_with_sensor() {
    SceneBuilder builder = make_builder(2);
    MaterialSpec leaf = diffuse("leaf", .05, .05, 2);
    leaf.lower[1] = leaf.upper[1] = {.reflectance = .4, .transmittance = .4};
    builder.add_material(leaf);
    builder.add_material(diffuse("soil", .2, 0, 2));
    builder.add_material(sensor("sensor", 2));
    add_leaves(builder, random_leaves(60, .3, 1, 3));
    builder.add_organ(organ("", "sensor", {{{.2, .2, .5}, {.8, .2, .5}, {.5, .8, .5}}}));
    builder.set_ground(ground("soil"));
    return std::move(builder).build();
}

/// The same light in all bands.
Sources lights(std::size_t sets) {
    const std::vector<double> all(2 * sets, 1);
    return {sun(35, all), sky(all)};
}

/// Whether copies of a band have its light. In a pack of dark bands alone light is not sent on as
/// often as among bright ones: once what is left is 1e-5 of what was scattered first.
void expect_copies(const Result& many, const Result& few, std::size_t band, double tolerance) {
    const std::size_t sets = many.bands / few.bands;
    for (std::size_t set = 0; set < sets; ++set) {
        const std::size_t copy = repeated_band(band, set, sets);
        for (std::size_t i = 0; i < few.organs(); ++i) {
            for (const QuantityEntry& entry : quantity_table()) {
                const Estimate& e = many.at(i, entry.quantity, copy);
                const Estimate& own = few.at(i, entry.quantity, band);
                EXPECT_NEAR(e.mean, own.mean, tolerance * own.mean);
                EXPECT_NEAR(e.standard_error, own.standard_error, tolerance * own.mean);
            }
        }
        const BandBudget& budget = many.budget[copy];
        EXPECT_NEAR(
            budget.escaped.mean, few.budget[band].escaped.mean, tolerance * budget.emitted.mean);
        EXPECT_GE(budget.cut_off.mean, few.budget[band].cut_off.mean);
        EXPECT_LT(budget.cut_off.mean, 1e-5 * budget.emitted.mean);
        EXPECT_LT(budget.closure_error, 1e-12);
    }
}

TEST(ManyBands, HaveTheLightOfFew) {
    const Scene few = stand_with_sensor();
    RunSpec spec = spec_of(Method::ray_bundles, 1 << 10);
    spec.replicates = 2;
    const Result two = run(few, lights(1), spec);
    for (const std::size_t sets : {std::size_t{3}, std::size_t{7}}) {
        const Scene many = with_repeated_bands(few, sets);
        for (spec.threads = 1; spec.threads <= 5; spec.threads += 4) {
            const Result result = run(many, lights(sets), spec);
            expect_copies(result, two, 0, 1e-4);
            expect_copies(result, two, 1, 0);
        }
    }
}

}  // namespace
}  // namespace quasimc::test

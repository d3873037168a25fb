// Reflectance, transmittance and absorptance of canopies.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

class Fractions : public BothWays {};

/// Whether a fraction agrees with the expected one within its error. Errors count as at least 1e-6:
/// triangles are traced in single precision.
::testing::AssertionResult is_near(const Estimate& fraction, double expected, double resolution) {
    Measured m = measured(fraction, kReplicates);
    m.standard_error = std::max(m.standard_error, 1e-6 * expected);
    return agrees(m, expected, resolution);
}

/// Infinite sheets above a soil of albedo 0.3; the answers are those of the adding method.
Scene make_sheets_over_soil(int sheets, bool has_soil = true) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("sheet", .1, .2));
    builder.add_material(diffuse("soil", .3, 0));
    for (int i = 0; i < sheets; ++i) {
        builder.add_organ(organ("", "sheet", floor_of(0, 2, 0, 1, 1 + i)));
    }
    if (has_soil) {
        builder.set_ground(ground("soil"));
    }
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 2, .size_y = 1});
    return std::move(builder).build();
}

TEST_P(Fractions, OfSheetsAreThoseOfTheAddingMethod) {
    struct Case {
        int sheets;
        double absorbed, soil, reflected;
    };
    for (const Case& c : {Case{1, .743299, .206186, .112371}, Case{2, .866260, .041706, .104546}}) {
        for (const auto& light : {sun(0, {5}), sun(40, {5}), sky({5})}) {
            const Result result = trace(make_sheets_over_soil(c.sheets), {light}, 1 << 12);
            const CanopyFractions& f = result.canopy.at(0);
            const double resolution = from_sources() ? 6e-3 : 2e-2;
            const double level = sidak_level(kLevel, 24);
            const auto check = [&](const Estimate& e, double expected) {
                EXPECT_TRUE(agrees(measured(e, kReplicates), expected, resolution, level));
            };
            check(f.reflectance, c.reflected);
            check(f.transmittance, c.soil);
            check(f.absorptance, c.absorbed);
            check(f.ground_absorptance, .7 * c.soil);
            const Estimate& emitted = result.budget[0].emitted;
            // The light of each direction of a sky is rounded to a quantum, 1e-12 of all.
            constexpr double kQuanta = 1e-10;
            EXPECT_NEAR(
                f.incident, emitted.mean, 6 * emitted.standard_error + kQuanta * f.incident);
        }
    }
}

TEST_P(Fractions, AddUpToOneButForTheRoulette) {
    const Result result = trace(make_sheets_over_soil(2), {sun(30, {1}), sky({2})}, 1 << 10);
    const CanopyFractions& f = result.canopy.at(0);
    const double open = f.reflectance.mean + f.absorptance.mean + f.ground_absorptance.mean - 1 -
                        result.budget[0].imbalance.mean / result.budget[0].emitted.mean;
    EXPECT_NEAR(open, 0, 1e-12);
}

/// One number has one error, whether it is called a fraction of the canopy or of all organs.
TEST_P(Fractions, OfAllOrgansAreTheSharesOfTheirGroup) {
    for (const std::uint64_t paths : {1U << 5, 1U << 10}) {
        const Result result = trace(make_sheets_over_soil(3), {sun(30, {1}), sky({2})}, paths);
        const Estimate& fraction = result.canopy.at(0).absorptance;
        const Estimate& share = result.groups.share(0, GroupShare::incident, 0);
        EXPECT_GT(fraction.standard_error, 0);
        EXPECT_NEAR(fraction.mean, share.mean, 1e-12);
        EXPECT_NEAR(fraction.standard_error, share.standard_error, 1e-9 * share.standard_error);
        EXPECT_NEAR(fraction.ci95_low, share.ci95_low, 1e-12);
        EXPECT_NEAR(fraction.ci95_high, share.ci95_high, 1e-12);
    }
}

/// Errors of complementary fractions have opposite signs.
TEST_P(Fractions, HaveErrorsOfTheirOwn) {
    const Result result = trace(make_sheets_over_soil(1), {sky({1})}, 1 << 10);
    const CanopyFractions& f = result.canopy.at(0);
    for (const Estimate& e : {f.reflectance, f.transmittance, f.absorptance}) {
        EXPECT_GT(e.standard_error, 0);
        EXPECT_LT(e.standard_error, .05);
        EXPECT_LT(e.ci95_low, e.mean);
        EXPECT_GT(e.ci95_high, e.mean);
    }
}

TEST_P(Fractions, WithoutAGroundAreAbsorptancesOfOrgansAlone) {
    const Result result = trace(make_sheets_over_soil(1, false), {sun(0, {1})}, 1 << 10);
    const CanopyFractions& f = result.canopy.at(0);
    EXPECT_TRUE(is_near(f.absorptance, .7, .02));
    EXPECT_TRUE(std::isnan(f.reflectance.mean)) << "light upwards and downwards is not separated";
    EXPECT_TRUE(std::isnan(f.transmittance.mean));
}

/// A soil of area 4, and optionally a black plate of 0.25 that casts its shadow on it.
Scene make_plot(double albedo, bool has_plate) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_material(diffuse("soil", albedo, 0));
    if (has_plate) {
        builder.add_organ(organ("", "black", floor_of(0, .5, 0, .5, .1)));
    }
    GroundSpec soil = ground("soil");
    soil.extent = {{-1, -1, 1, 1}};
    builder.set_ground(soil);
    return std::move(builder).build();
}

TEST_P(Fractions, OfAPlotAreOfTheLightOnItsArea) {
    const Result result = trace(make_plot(0, true), {sun(0, {2})}, 1 << 12);
    const CanopyFractions& f = result.canopy.at(0);
    EXPECT_DOUBLE_EQ(f.incident, 8);
    EXPECT_TRUE(is_near(f.transmittance, 1 - .0625, .01));
    EXPECT_TRUE(is_near(f.absorptance, .0625, .01));
    EXPECT_TRUE(is_near(f.ground_absorptance, 1 - .0625, .01));
}

TEST_P(Fractions, OfABarePlotAreItsAlbedo) {
    const Result result = trace(make_plot(.3, false), {sun(0, {2})}, 1 << 12);
    const CanopyFractions& f = result.canopy.at(0);
    EXPECT_TRUE(is_near(f.transmittance, 1, 1e-3));
    EXPECT_TRUE(is_near(f.ground_absorptance, .7, 1e-3));
    if (from_sources()) {
        EXPECT_TRUE(is_near(f.reflectance, .3, .02));
    } else {
        EXPECT_TRUE(std::isnan(f.reflectance.mean)) << "what escapes is a remainder";
    }
}

TEST_P(Fractions, NeedAGroundOrACell) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .2));
    builder.add_organ(organ("", "leaf", floor_of(0, 1, 0, 1, 1)));
    EXPECT_TRUE(trace(std::move(builder).build(), {sun(0, {1})}, 64).canopy.empty());
}

TEST_P(Fractions, OfLightThatNeverReachedTheGroundAreABound) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("", "black", floor_of(0, 1, 0, 1, 1)));
    builder.set_ground(ground("black"));
    builder.set_cell({.along_x = true, .along_y = true});
    const Result result = trace(std::move(builder).build(), {sun(0, {1})}, 256);
    const Estimate& through = result.canopy.at(0).transmittance;
    EXPECT_EQ(through.mean, 0);
    EXPECT_TRUE(std::isnan(through.standard_error));
    EXPECT_GT(through.ci95_high, 0);
    EXPECT_LT(through.ci95_high, .05);
}

QUASIMC_BOTH_WAYS(Fractions);

}  // namespace
}  // namespace quasimc::test

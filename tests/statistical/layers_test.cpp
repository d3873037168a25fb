// Horizontal layers: nets that thin the light out, infinite sheets, shadows across a periodic cell.

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "geometry/shapes/shapes.h"
#include "samplers/catalogue.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

using std::numbers::sqrt2;

constexpr double kDegree = std::numbers::pi / 180;
constexpr Cell kUnitCell{.along_x = true, .along_y = true};

class Layers : public BothWays {};

/// Sensor 0, net, sensor 1, net, ... from the top; all 1x1, in one beam straight down.
Scene make_nets(int nets, const std::vector<double>& tau) {
    SceneBuilder builder = make_builder(tau.size());
    builder.add_material(net("net", tau));
    builder.add_material(sensor("sensor", tau.size()));
    for (int i = 0; i <= nets; ++i) {
        builder.add_organ(organ(fmt::format("sensor {}", i), "sensor", floor_of(0, 1, 0, 1, -i)));
        if (i < nets) {
            builder.add_organ(
                organ(fmt::format("net {}", i), "net", floor_of(0, 1, 0, 1, -i - .5)));
        }
    }
    return std::move(builder).build();
}

TEST_P(Layers, ASensorUnderNetsReadsWhatTheyLetThrough) {
    const Scene scene = make_nets(3, {.1});
    const Result result = trace(scene, {sun(0, {1})}, 1 << 15);
    for (int k = 0; k <= 3; ++k) {
        const double left = std::pow(.1, k);
        EXPECT_TRUE(holds(
            {fmt::format("{} nets tau .1", k), left, .2 * left, 4},
            result.at(static_cast<std::size_t>(2 * k), Quantity::incident_upper, 0)));
    }
}

/// A second band, for which the nets are clear, keeps paths alive whatever the first has lost. Then
/// the first band's light passes ten nets as well. The fixed point of the tallies ends at 2^-29 of
/// a path's mean light (light tracing; tracing from organs 2^-41), so smaller values are noise.
TEST_P(Layers, ABandForWhichTheNetsAreClearCarriesTheOtherThroughTen) {
    const Scene scene = make_nets(10, {.1, 1});
    const Result result = trace(scene, {sun(0, {1, 1})}, 1 << 12);
    for (int k = 0; k <= 10; ++k) {
        const double left = std::pow(.1, k);
        const auto sensor = static_cast<std::size_t>(2 * k);
        const Estimate& clear = result.at(sensor, Quantity::incident_upper, 1);
        EXPECT_TRUE(agrees(measured(clear, kReplicates), 1, .05, sidak_level(kLevel, 22)));
        // Light through nets is scattered light. Points can't exclude direct light as precisely.
        const Quantity quantity = k > 0 ? Quantity::incident_scattered : Quantity::incident_upper;
        const Estimate& thin = result.at(sensor, quantity, 0);
        constexpr int kReach = 5;  // 10^-5 is 2684 quanta of the fixed point; beyond, quanta count
        if (k <= kReach) {
            // Intervals treat such weak light as that of few paths, though it has many
            // contributions.
            EXPECT_NEAR(thin.mean, left, .01 * left) << k << " nets";
            EXPECT_LE(thin.ci95_low, left);
            EXPECT_GE(thin.ci95_high, left);
        } else {
            EXPECT_NEAR(thin.mean, left, 0x1p-28);
        }
    }
}

TEST_P(Layers, AnInfiniteTileAbsorbsByTheCosineOfTheSun) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("tile", .2, .1));
    builder.add_organ(organ("tile", "tile", floor_of(0, 1, 0, 1, 0)));
    builder.set_cell(kUnitCell);
    const Scene scene = std::move(builder).build();
    for (const double zenith : {0.0, 60.0}) {
        const Result result = trace(scene, {sun(zenith, {1})}, 1 << 12);
        EXPECT_TRUE(holds(
            {fmt::format("periodic tile, sun at zenith angle {}, absorbed", zenith),
             zenith == 0 ? .7 : .35, 1e-4, 2},
            result.at(0, Quantity::absorbed_flux, 0)));
    }
}

/// Plates x 0.85..1 at z 1 and x 0...9 at z 0, 1 deep, in [0, 1]^2; the sun is at 45 degrees, so
/// shadows fall 1 to the side.
Scene make_plates(const Cell& cell) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("high", "black", floor_of(.85, 1, 0, 1, 1)));
    builder.add_organ(organ("low", "black", floor_of(0, .9, 0, 1, 0)));
    builder.set_cell(cell);
    return std::move(builder).build();
}

TEST_P(Layers, AShadowComesBackOnTheOtherSideOfAPeriodicCell) {
    struct Case {
        Cell cell;
        std::string words;
        double low;
    };
    const std::array<Case, 4> cases{{
        {{}, "open", 90},
        {{.along_y = true}, "periodic along y", 90},
        {{.along_x = true}, "periodic along x", 85},
        {kUnitCell, "periodic along x and y", 85},
    }};
    for (const Case& c : cases) {
        const Result result = trace(make_plates(c.cell), {sun(45, {100 * sqrt2})}, 1 << 14);
        EXPECT_TRUE(holds(
            {"shadow domain, " + c.words + ", high plate", 15, .2, 8},
            result.at(0, Quantity::absorbed_flux, 0)));
        EXPECT_TRUE(holds(
            {"shadow domain, " + c.words + ", low plate", c.low, .2, 8},
            result.at(1, Quantity::absorbed_flux, 0)));
    }
}

/// Infinite Lambertian sheets above a soil (adding method).
struct Sheets {
    std::string_view words;
    int count;
    double rho, tau, soil;
    std::array<double, 2> top, bottom, absorbed;
    double ground, reflected;  ///< falls on the soil; leaves upwards
};

constexpr std::array<Sheets, 3> kSheets{{
    {"sheet (.1, .2, .3)", 1, .1, .2, .3, {1}, {.061856}, {.743299}, .206186, .112371},
    {"2 sheets (.1, .2, .3)",
     2,
     .1,
     .2,
     .3,
     {1, .202273},
     {.022730, .012512},
     {.715911, .150349},
     .041706,
     .104546},
    {"2 sheets (.3912, .4146, .2142)",
     2,
     .3912,
     .4146,
     .2142,
     {1, .498772},
     {.215164, .048346},
     {.235985, .106250},
     .225704,
     .480407},
}};

Scene make_sheets(const Sheets& sheets) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("sheet", sheets.rho, sheets.tau));
    builder.add_material(diffuse("soil", sheets.soil, 0));
    for (int i = 0; i < sheets.count; ++i) {
        builder.add_organ(
            organ(fmt::format("sheet {}", i + 1), "sheet", floor_of(0, 1, 0, 1, 3 - i)));
    }
    builder.set_ground(ground("soil"));
    builder.set_cell(kUnitCell);
    return std::move(builder).build();
}

void check_sheets(
    const Sheets& sheets, const std::string& light, double resolution, const Result& result) {
    const unsigned family = 6 * (3 * static_cast<unsigned>(sheets.count) + 2);
    const std::string words = fmt::format("{}{}", sheets.words, light);
    for (int i = 0; i < sheets.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const std::string where = fmt::format("{}, E on top of sheet {}", words, i + 1);
        const std::string below = fmt::format("{}, E below sheet {}", words, i + 1);
        const std::string taken = fmt::format("{}, absorbed by sheet {}", words, i + 1);
        EXPECT_TRUE(holds(
            {where, sheets.top[k], resolution, family}, result.at(k, Quantity::incident_upper, 0)));
        EXPECT_TRUE(holds(
            {below, sheets.bottom[k], resolution, family},
            result.at(k, Quantity::incident_lower, 0)));
        EXPECT_TRUE(holds(
            {taken, sheets.absorbed[k], resolution, family},
            result.at(k, Quantity::absorbed_flux, 0)));
    }
    EXPECT_TRUE(holds(
        {words + ", E on the soil", sheets.ground, resolution, family},
        result.at(static_cast<std::size_t>(sheets.count), Quantity::incident_upper, 0)));
    EXPECT_TRUE(
        holds({words + ", R", sheets.reflected, resolution, family}, result.budget[0].escaped));
}

TEST_P(Layers, InfiniteSheetsShareTheLightAsTheAddingMethodHasIt) {
    for (const Sheets& sheets : kSheets) {
        const Scene scene = make_sheets(sheets);
        const double resolution = from_sources() ? 3e-3 : 8e-3;
        check_sheets(sheets, ", sun overhead", resolution, trace(scene, {sun(0, {1})}, 1 << 13));
        check_sheets(sheets, ", uniform sky", resolution, trace(scene, {sky({1})}, 1 << 13));
    }
}

TEST_P(Layers, EverySamplerSharesTheLightOfSheetsAlike) {
    const Sheets& sheets = kSheets.back();
    const Scene scene = make_sheets(sheets);
    const double level = sidak_level(kLevel, 3 * static_cast<unsigned>(sampler_catalogue().size()));
    for (const SamplerEntry& sampler : sampler_catalogue()) {
        SCOPED_TRACE(sampler.name);
        RunSpec spec = spec_of(GetParam(), 1 << 11);
        spec.sampler = sampler.name;
        const Result result = run(scene, {sun(40, {1 / std::cos(40 * kDegree)}), sky({1})}, spec);
        for (const std::size_t i : {0U, 1U}) {
            EXPECT_TRUE(agrees(
                measured(result.at(i, Quantity::absorbed_flux, 0), kReplicates),
                2 * sheets.absorbed[i], .02, level));
        }
        EXPECT_TRUE(agrees(
            measured(result.at(2, Quantity::incident_upper, 0), kReplicates), 2 * sheets.ground,
            .06, level));
    }
}

QUASIMC_BOTH_WAYS(Layers);

}  // namespace
}  // namespace quasimc::test

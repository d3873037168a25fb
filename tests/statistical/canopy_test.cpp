// Random canopies against Beer's law and the turbid medium.
//
// Each seed is one canopy and one run of one replicate; what is measured is the mean over the
// seeds, so its error holds both the scatter of the canopies and that of the paths.
//
// A medium has no leaf size, a canopy has. The reflectance of conservative leaves (rho = tau = 0.5,
// LAI 3, sun overhead, medium 0.4410) shows it most, as light that returns along its path finds the
// gap that it came through: 0.4448, 0.4440, 0.4424 and 0.4421 (each +- 0.0004) with leaves of
// 0.118, 0.083, 0.042 and 0.021 of the canopy's height. Here they are 0.021, where that is less
// than the resolution.

#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "statistical/canopies.h"

namespace quasimc::test {
namespace {

class Canopies : public BothWays {};

CanopySpec black_canopy() {
    return {.leaf_area_index = 1, .leaf = diffuse("leaf", 0, 0), .soil = diffuse("soil", 0, 0)};
}

TEST_P(Canopies, BlackLeavesTakeTheSunsLightByBeersLaw) {
    const auto numbers = [&](std::uint64_t seed) {
        const Scene scene = make_canopy(black_canopy(), seed);
        const Result result = trace_once(
            scene, {sun(36, {1 / std::cos(std::numbers::pi / 5)})}, GetParam(), 1 << 13, seed);
        return std::vector<double>{
            result.at(kCanopy, Quantity::absorbed_flux, 0).mean / kCellArea,
            result.at(kSoil, Quantity::incident_upper, 0).mean,
            result.sunlit_fraction[kCanopy].mean};
    };
    const std::vector<Measured> m = over_seeds(48, numbers);
    EXPECT_TRUE(holds({"black canopy LAI 1, sun at 36, absorbed", .460997, 8e-3, 3}, m[0]));
    EXPECT_TRUE(holds({"black canopy LAI 1, sun at 36, on the soil", 1 - .460997, 8e-3, 3}, m[1]));
    EXPECT_TRUE(holds({"black canopy LAI 1, sun at 36, sunlit fraction", .745909, .02, 3}, m[2]));
}

TEST_P(Canopies, BlackLeavesTakeTheSkysLightByBeersLaw) {
    // In first hits the light on the soil depends on a few directions about the zenith.
    const std::uint64_t paths = GetParam() == Method::first_hits ? 1 << 14 : 1 << 13;
    const auto numbers = [&](std::uint64_t seed) {
        const Result result =
            trace_once(make_canopy(black_canopy(), seed), {sky({1})}, GetParam(), paths, seed);
        return std::vector<double>{
            result.at(kCanopy, Quantity::absorbed_flux, 0).mean / kCellArea,
            result.at(kSoil, Quantity::incident_upper, 0).mean};
    };
    const std::vector<Measured> m = over_seeds(64, numbers);
    EXPECT_TRUE(holds({"black canopy LAI 1, uniform sky, absorbed", .556791, .01, 2}, m[0]));
    EXPECT_TRUE(
        holds({"black canopy LAI 1, uniform sky, on the soil", 1 - .556791, 8e-3, 2}, m[1]));
}

/// A control: the law must fail for leaves that are a tenth larger.
TEST(LargerLeaves, AreNotTakenForSmallerOnes) {
    CanopySpec spec = black_canopy();
    spec.leaf_area_index *= 1.1;
    const auto numbers = [&](std::uint64_t seed) {
        const Result result =
            trace_once(make_canopy(spec, seed), {sky({1})}, Method::light_tracing, 1 << 13, seed);
        return std::vector<double>{result.at(kCanopy, Quantity::absorbed_flux, 0).mean / kCellArea};
    };
    EXPECT_FALSE(agrees(over_seeds(64, numbers)[0], .556791, .01));
}

/// Leaves that reach out of the sphere widen its shadow: at x 3.75 the crown transmits 0.1205,
/// 0.1237 and 0.1259 (+- 0.0005) with 4000, 16000 and 64000 leaves in the cube around it.
TEST_P(Canopies, ASphericalCrownCastsTheShadowOfATurbidSphere) {
    constexpr std::array<std::array<double, 2>, 2> kCases{{{1, .528482}, {3.75, .126335}}};
    for (const auto& [depth, transmitted] : kCases) {
        const auto numbers = [&, d = depth](std::uint64_t seed) {
            const Result result =
                trace_once(make_crown(50000, d, seed), {sun(0, {1})}, GetParam(), 1 << 14, seed);
            const double shadow = std::numbers::pi / 4;
            return std::vector<double>{1 - result.at(0, Quantity::absorbed_flux, 0).mean / shadow};
        };
        EXPECT_TRUE(holds(
            {fmt::format("turbid sphere crown, x {}, transmitted", depth), transmitted,
             from_sources() ? .01 : .02, 2},
            over_seeds(24, numbers)[0]));
    }
}

/// Light absorbed by a medium's leaves, reflected, and transmitted to a black soil.
struct Shares {
    double absorbed, reflected, transmitted;
};

/// References for PAR (0.0735/0.0566), NIR (0.3912/0.4146) and optionally rho = tau = 0.5; standard
/// errors up to 5e-4.
struct Medium {
    std::string name;
    std::string words;
    double leaf_area_index;
    bool sun;
    std::array<Shares, 3> bands;
};

class TurbidMedium : public ::testing::TestWithParam<std::tuple<Medium, Method>> {
  protected:
    [[nodiscard]] static Method from() { return std::get<1>(GetParam()); }
    [[nodiscard]] static bool from_sources() { return from() != Method::from_organs; }

    static CanopySpec canopy(double leaf_area_index) {
        const std::vector<SideOptics> side{
            {.reflectance = .0735, .transmittance = .0566},
            {.reflectance = .3912, .transmittance = .4146},
            {.reflectance = .5, .transmittance = .5}};
        return {
            .leaf_area_index = leaf_area_index,
            .leaf = {"leaf", side, side},
            .soil = diffuse("soil", 0, 0, 3)};
    }

    void check(const Medium& medium) const {
        const std::vector<double> unit(3, 1);
        const Sources sources{medium.sun ? sun(0, unit) : sky(unit)};
        const auto numbers = [&](std::uint64_t seed) {
            const Scene scene = make_canopy(canopy(medium.leaf_area_index), seed);
            const Result result = trace_once(
                scene, sources, from(), from() == Method::light_tracing ? 1 << 13 : 1 << 14, seed);
            std::vector<double> shares;
            for (std::size_t b = 0; b < 3; ++b) {
                shares.push_back(result.at(kCanopy, Quantity::absorbed_flux, b).mean / kCellArea);
                shares.push_back(result.budget[b].escaped.mean / kCellArea);
                shares.push_back(result.at(kSoil, Quantity::incident_upper, b).mean);
            }
            return shares;
        };
        const std::vector<Measured> m = over_seeds(from_sources() ? 48 : 32, numbers);
        constexpr std::array<const char*, 3> kBands{"PAR", "NIR", "rho = tau = .5"};
        for (std::size_t b = 0; b < 3; ++b) {
            const Shares& shares = medium.bands[b];
            if (shares.transmitted == 0) {
                continue;
            }
            const std::string words = fmt::format("turbid slab, {}, {}", medium.words, kBands[b]);
            if (shares.absorbed > 0) {
                hold(words + ", A", shares.absorbed, m[3 * b]);
            } else {
                EXPECT_NEAR(m[3 * b].mean, 0, 1e-12);
            }
            hold(words + ", T", shares.transmitted, m[3 * b + 2]);
            // From organs, escaped light is the remainder of the two.
            if (from_sources()) {
                hold(words + ", R", shares.reflected, m[3 * b + 1]);
            }
        }
    }

  private:
    /// The expected value has an error of its own.
    void hold(const std::string& what, double expected, Measured m) const {
        constexpr double kTableError = 5e-4;
        m.standard_error = std::hypot(m.standard_error, kTableError);
        const double resolution = from_sources() ? .004 + .01 * expected : .007 + .025 * expected;
        EXPECT_TRUE(holds({what, expected, resolution, 9}, m));
    }
};

TEST_P(TurbidMedium, ScattersTheLight) {
    check(std::get<0>(GetParam()));
}

const Medium kSunLai1{
    "SunLai1",
    "LAI 1, zenith 0",
    1,
    true,
    {{{.36194, .01783, .62024}, {.11698, .14022, .74280}, {}}}};
const Medium kSunLai3{
    "SunLai3",
    "LAI 3, zenith 0",
    3,
    true,
    {{{.74086, .02430, .23484}, {.34658, .25024, .40318}, {0, .44102, .55898}}}};
const Medium kSkyLai1{
    "SkyLai1",
    "LAI 1, uniform sky",
    1,
    false,
    {{{.51351, .02491, .46158}, {.16784, .20600, .62616}, {}}}};
const Medium kSkyLai3{
    "SkyLai3",
    "LAI 3, uniform sky",
    3,
    false,
    {{{.84518, .03031, .12450}, {.39390, .31526, .29084}, {0, .54274, .45726}}}};

std::string name_of_medium(const ::testing::TestParamInfo<TurbidMedium::ParamType>& info) {
    return std::get<0>(info.param).name + name_of({std::get<1>(info.param), info.index});
}

using MediumAndWay = TurbidMedium::ParamType;

INSTANTIATE_TEST_SUITE_P(
    EveryMedium,
    TurbidMedium,
    ::testing::Values(
        MediumAndWay{kSunLai3, Method::light_tracing},
        MediumAndWay{kSkyLai1, Method::light_tracing},
        MediumAndWay{kSkyLai3, Method::first_hits},
        MediumAndWay{kSunLai1, Method::from_organs}),
    name_of_medium);

/// The remaining combinations.
INSTANTIATE_TEST_SUITE_P(
    Long,
    TurbidMedium,
    ::testing::Values(
        MediumAndWay{kSunLai1, Method::light_tracing},
        MediumAndWay{kSkyLai3, Method::light_tracing},
        MediumAndWay{kSunLai1, Method::first_hits},
        MediumAndWay{kSunLai3, Method::first_hits},
        MediumAndWay{kSkyLai1, Method::first_hits},
        MediumAndWay{kSunLai3, Method::from_organs},
        MediumAndWay{kSkyLai1, Method::from_organs},
        MediumAndWay{kSkyLai3, Method::from_organs},
        MediumAndWay{kSunLai3, Method::ray_bundles},
        MediumAndWay{kSkyLai3, Method::ray_bundles}),
    name_of_medium);

/// rho + tau = 1 and a white soil: nothing is absorbed, all light is reflected.
CanopySpec white_canopy() {
    return {
        .leaves = 1000,
        .leaf_area_index = 5,
        .leaf = diffuse("leaf", .6, .4),
        .soil = diffuse("soil", 1, 0)};
}

TEST_P(Canopies, AWhiteCanopyAboveAWhiteSoilReflectsAllAndAbsorbsNothing) {
    const Result result = trace(make_canopy(white_canopy(), 1), {sun(30, {1}), sky({1})}, 1 << 10);
    const BandBudget& budget = result.budget[0];
    EXPECT_NEAR(budget.absorbed_by_organs.mean, 0, 1e-12);
    EXPECT_EQ(budget.absorbed_by_ground.mean, 0);
    EXPECT_EQ(budget.cut_off.mean, 0);
    // Light scattered by lit surfaces is rounded to whole paths, block by block.
    EXPECT_TRUE(holds(
        {"white canopy LAI 5, white soil, R", 1, resolution(1e-5, 5e-3)},
        Measured{
            budget.escaped.mean / budget.emitted.mean,
            budget.escaped.standard_error / budget.emitted.mean, kReplicates}));
}

/// Where nothing is absorbed, a uniform sky fills all of space with its own radiance.
TEST_P(Canopies, AWhiteCanopyUnderAUniformSkyIsAsBrightAsTheSkyEverywhere) {
    const Result result = trace(make_canopy(white_canopy(), 1), {sky({1})}, 1 << 11);
    EXPECT_TRUE(holds(
        {"white canopy LAI 5, uniform sky, E on upper sides", 1, .1, 3},
        result.at(kCanopy, Quantity::incident_upper, 0)));
    EXPECT_TRUE(holds(
        {"white canopy LAI 5, uniform sky, E on lower sides", 1, .1, 3},
        result.at(kCanopy, Quantity::incident_lower, 0)));
    EXPECT_TRUE(holds(
        {"white canopy LAI 5, uniform sky, E on the soil", 1, .1, 3},
        result.at(kSoil, Quantity::incident_upper, 0)));
}

/// NIR, leaf area index 1, black soil, sun overhead: the turbid medium (Monte Carlo, errors of 5e-4
/// or less). Each seed is a canopy and a run.
TEST_P(Canopies, HaveTheFractionsOfATurbidMedium) {
    const CanopySpec spec{
        .leaf_area_index = 1, .leaf = diffuse("leaf", .3912, .4146), .soil = diffuse("soil", 0, 0)};
    const auto numbers = [&](std::uint64_t seed) {
        const CanopyFractions f =
            trace_once(make_canopy(spec, seed), {sun(0, {1})}, GetParam(), 1 << 12, seed)
                .canopy.at(0);
        return std::vector<double>{
            f.absorptance.mean, f.reflectance.mean, f.transmittance.mean,
            f.ground_absorptance.mean};
    };
    const std::vector<Measured> m = over_seeds(24, numbers);
    const std::array<double, 4> expected{.11698, .14022, .74280, .74280};
    for (std::size_t i = 0; i < m.size(); ++i) {
        Measured own = m[i];
        own.standard_error = std::hypot(own.standard_error, 5e-4);
        EXPECT_TRUE(agrees(own, expected[i], .03, sidak_level(kLevel, 12))) << i;
    }
}

QUASIMC_BOTH_WAYS(Canopies);

}  // namespace
}  // namespace quasimc::test

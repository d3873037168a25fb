// The all-weather sky: Perez, Seals and Michalsky (1993), "All-weather model for sky luminance
// distribution: preliminary configuration and validation", Solar Energy 50, 235-245, with the
// erratum of 51, 423.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/text.h"
#include "light/models/perez_formula.h"
#include "light/models/source.h"

namespace quasimc {
namespace {

/// x1 + x2 Z + delta (x3 + x4 Z), for each of a, b, c, d, e; Z the sun's zenith angle.
using CoefficientRow = std::array<std::array<double, 4>, 5>;

/// A range of clearness, up to `until`, with its row of table 1.
struct Bin {
    double until;
    CoefficientRow row;
};

// clang-format off
constexpr std::array<Bin, 8> kBins{{
    {1.065, {{{1.3525, -0.2576, -0.2690, -1.4366}, {-0.7670, 0.0007, 1.2734, -0.1233},
              {2.8000, 0.6004, 1.2375, 1.0000}, {1.8734, 0.6297, 0.9738, 0.2809},
              {0.0356, -0.1246, -0.5718, 0.9938}}}},
    {1.230, {{{-1.2219, -0.7730, 1.4148, 1.1016}, {-0.2054, 0.0367, -3.9128, 0.9156},
              {6.9750, 0.1774, 6.4477, -0.1239}, {-1.5798, -0.5081, -1.7812, 0.1080},
              {0.2624, 0.0672, -0.2190, -0.4285}}}},
    {1.500, {{{-1.1000, -0.2515, 0.8952, 0.0156}, {0.2782, -0.1812, -4.5000, 1.1766},
              {24.7219, -13.0812, -37.7000, 34.8438}, {-5.0000, 1.5218, 3.9229, -2.6204},
              {-0.0156, 0.1597, 0.4199, -0.5562}}}},
    {1.950, {{{-0.5484, -0.6654, -0.2672, 0.7117}, {0.7234, -0.6219, -5.6812, 2.6297},
              {33.3389, -18.3000, -62.2500, 52.0781}, {-3.5000, 0.0016, 1.1477, 0.1062},
              {0.4659, -0.3296, -0.0876, -0.0329}}}},
    {2.800, {{{-0.6000, -0.3566, -2.5000, 2.3250}, {0.2937, 0.0496, -5.6812, 1.8415},
              {21.0000, -4.7656, -21.5906, 7.2492}, {-3.5000, -0.1554, 1.4062, 0.3988},
              {0.0032, 0.0766, -0.0656, -0.1294}}}},
    {4.500, {{{-1.0156, -0.3670, 1.0078, 1.4051}, {0.2875, -0.5328, -3.8500, 3.3750},
              {14.0000, -0.9999, -7.1406, 7.5469}, {-3.4000, -0.1078, -1.0750, 1.5702},
              {-0.0672, 0.4016, 0.3017, -0.4844}}}},
    {6.200, {{{-1.0000, 0.0211, 0.5025, -0.5119}, {-0.3000, 0.1922, 0.7023, -1.6317},
              {19.0000, -5.0000, 1.2438, -1.9094}, {-4.0000, 0.0250, 0.3844, 0.2656},
              {1.0468, -0.3788, -2.4517, 1.4656}}}},
    {INFINITY, {{{-1.0500, 0.0289, 0.4260, 0.3590}, {-0.3250, 0.1156, 0.7781, 0.0025},
                 {31.0625, -14.5000, -46.1148, 55.3750}, {-7.2312, 0.4050, 13.3500, 0.6234},
                 {1.5000, -0.6426, 1.8564, 0.5636}}}},
}};
// clang-format on

void check(const SkyState& state) {
    Faults faults;
    const auto refuse = [&](std::string problem, std::string why, std::string suggestion) {
        faults.add({"Perez sky", std::move(problem), std::move(why), std::move(suggestion)});
    };
    if (!(state.to_sun.z >= 0)) {
        refuse(
            "the sun is below the horizon", "the model describes daytime skies",
            "use model = \"cie_overcast\" or \"uniform\" for twilight");
    }
    if (!(state.diffuse_horizontal > 0)) {
        refuse(
            fmt::format("diffuse_horizontal is {}", shortest(state.diffuse_horizontal)),
            "a sky without light has no distribution", "");
    }
    if (!(state.direct_normal >= 0)) {
        refuse(
            fmt::format("direct_normal is {}", shortest(state.direct_normal)),
            "it must be 0 or more", "");
    }
    faults.throw_if_any();
}

}  // namespace

PerezWeather perez_weather(const SkyState& state) {
    check(state);
    const double zenith = std::acos(std::min(1.0, state.to_sun.z));
    const double cube = 1.041 * zenith * zenith * zenith;
    const double ratio = 1 + state.direct_normal / state.diffuse_horizontal;
    // Kasten (1966).
    const double zenith_deg = zenith * 180 / std::numbers::pi;
    const double air_mass = 1 / (state.to_sun.z + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
    constexpr double kPerezSolarConstant = 1367;  // of the paper, W m-2
    const double outside = kPerezSolarConstant / (state.distance_au * state.distance_au);
    return {(ratio + cube) / (1 + cube), state.diffuse_horizontal * air_mass / outside};
}

SkyShape perez_shape(const SkyState& state) {
    const PerezWeather weather = perez_weather(state);
    const double zenith = std::acos(std::min(1.0, state.to_sun.z));
    std::size_t bin = 0;
    while (weather.clearness >= kBins[bin].until) {
        ++bin;
    }
    // The fits hold for usual brightnesses of skies, 0.01 to 0.6. Thin veils make b positive, and
    // the horizon infinitely bright: for intermediate skies the brightness counts as at least 0.2
    // (both limits as in gendaylit, Delaunay 1994), and a b that is still positive as 0.
    const bool is_intermediate = bin >= 1 && bin <= 4;
    const double delta = std::clamp(weather.brightness, is_intermediate ? 0.2 : 0.01, 0.6);
    const CoefficientRow& row = kBins[bin].row;
    std::array<double, 5> x{};
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = row[i][0] + row[i][1] * zenith + delta * (row[i][2] + row[i][3] * zenith);
    }
    if (bin == 0) {
        const auto& c = row[2];
        const auto& d = row[3];
        x[2] = std::exp(std::pow(delta * (c[0] + c[1] * zenith), c[2])) - c[3];
        x[3] = -std::exp(delta * (d[0] + d[1] * zenith)) + d[2] + delta * d[3];
    }
    const double b = std::min(0.0, x[1]);
    // Extrapolated to skies darker than any that was measured, the fits are black except for a rim
    // above the horizon: these skies get no gradation.
    constexpr double kSineOfRim = 0.1;
    const double a = 1 + x[0] * std::exp(b / kSineOfRim) <= 0 ? 0 : x[0];
    const PerezFormula formula{a, b, x[2], x[3], x[4]};
    return {
        [formula, to_sun = state.to_sun](const Vec3& d) { return formula.radiance(d, to_sun); },
        {},
        {}};
}

}  // namespace quasimc

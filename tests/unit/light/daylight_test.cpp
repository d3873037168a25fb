#include "light/daylight/daylight.h"

#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "light/daylight/clear_sky.h"
#include "light/daylight/diffuse_fraction.h"
#include "light/daylight/solar_reference.h"

namespace quasimc::test {
namespace {

TEST(Spectrum, IntegratesItsStraightLinesExactly) {
    const Spectrum spectrum({400, 500, 700}, {0, 2, 1});
    EXPECT_DOUBLE_EQ(spectrum.at(450), 1);
    EXPECT_DOUBLE_EQ(spectrum.at(600), 1.5);
    EXPECT_EQ(spectrum.at(399), 0);
    EXPECT_EQ(spectrum.at(701), 0);
    EXPECT_DOUBLE_EQ(spectrum.within({0, 5000}), 100 + 300);
    EXPECT_DOUBLE_EQ(spectrum.within({450, 500}), 75);
    EXPECT_EQ(spectrum.within({800, 900}), 0);
    // Photons of a flat spectrum: as of its middle wavelength.
    const Spectrum flat({400, 700}, {1, 1});
    EXPECT_NEAR(
        flat.within({400, 700, SpectralSpan::Count::photons}), 300 * photons_per_joule(550), 1e-9);
}

/// 1 W of 555 nm is 4.64 umol s-1 and 683 lm.
TEST(Spectrum, CountsPhotonsAndLumens) {
    EXPECT_NEAR(photons_per_joule(555), 4.6394, 1e-4);
    EXPECT_NEAR(photons_per_joule(400), 3.3437, 1e-4);
    EXPECT_NEAR(photopic_efficiency(555), 1, .006);
    EXPECT_DOUBLE_EQ(photopic_efficiency(510), .503);
    EXPECT_EQ(photopic_efficiency(800), 0);
    EXPECT_EQ(photopic_efficiency(300), 0);
}

/// The sums that ASTM G173-03 states, 1000.4 and 900.1 W m-2, and rows of its table.
TEST(SolarReference, IsTheWholeTable) {
    EXPECT_NEAR(reference_global().within({280, 4000}), 1000.4, .05);
    EXPECT_NEAR(reference_direct().within({280, 4000}), 900.1, .05);
    EXPECT_EQ(reference_global().wavelengths().size(), 2002U);
    EXPECT_EQ(reference_direct().wavelengths(), reference_global().wavelengths());
    struct Row {
        double nm, global, direct;
    };
    for (const Row& row :
         {Row{280, 4.7309e-23, 2.5361e-26}, Row{305.5, .018719, .010186}, Row{399.5, 1.1021, .8298},
          Row{400, 1.1141, .83989}, Row{761, .15396, .14328}, Row{933, .24841, .23459},
          Row{1362, 1.8076e-11, 1.7489e-11}, Row{1700, .19975, .19464}, Row{1702, .20396, .19874},
          Row{1705, .19778, .19275}, Row{2525, 4.1393e-5, 4.1194e-5},
          Row{2800, 1.6484e-12, 1.6665e-12}, Row{3995, .00721, .0072263},
          Row{4000, .0071043, .0071199}}) {
        EXPECT_DOUBLE_EQ(reference_global().at(row.nm), row.global) << row.nm;
        EXPECT_DOUBLE_EQ(reference_direct().at(row.nm), row.direct) << row.nm;
    }
}

/// McCree (1972) and Thimijan and Heins (1983): 4.57 umol J-1 of PAR, 2.0 to 2.1 umol per J of
/// global light, 54 lx per umol m-2 s-1, in sun and sky.
TEST(SolarReference, ContinuesAPartOfItselfToTheWhole) {
    const Spectrum& whole = reference_global();
    std::vector<double> nm, values;
    for (const double each : whole.wavelengths()) {
        if (each >= 400 && each <= 1100) {
            nm.push_back(each);
            values.push_back(3 * whole.at(each));
        }
    }
    const Spectrum all = continued(Spectrum(nm, values), whole);
    EXPECT_EQ(all.wavelengths(), whole.wavelengths());
    for (const double each : {290., 399.5, 400., 700., 1100., 1101., 2500., 4000.}) {
        EXPECT_NEAR(all.at(each), 3 * whole.at(each), 1e-9) << each;
    }
    const Spectrum dark = continued(Spectrum({400, 500, 600}, {0, 1, 0}), whole);
    EXPECT_EQ(dark.low_nm(), 400) << "a row of 0 is the end of the light";
    EXPECT_EQ(dark.high_nm(), 600);
}

TEST(Daylight, HasTheKnownConversions) {
    const DaylightSpectra spectra;
    const Daylight light = spectra.from_fraction(1000, LightUnit::full_spectrum, .2);
    const auto amount = [&](LightUnit unit) {
        return spectra.direct(span_of(unit)) * light.direct + spectra.diffuse(span_of(unit), light);
    };
    EXPECT_NEAR(amount(LightUnit::full_spectrum), 1000, 1e-9);
    EXPECT_NEAR(amount(LightUnit::ppfd) / amount(LightUnit::par), 4.57, .04);
    EXPECT_NEAR(amount(LightUnit::par) / 1000, .43, .01);
    EXPECT_NEAR(amount(LightUnit::lux) / amount(LightUnit::ppfd), 54, 1.5);
}

TEST(Daylight, ComesBackFromEveryUnit) {
    const DaylightSpectra spectra;
    for (const LightUnit unit :
         {LightUnit::full_spectrum, LightUnit::par, LightUnit::ppfd, LightUnit::lux}) {
        for (const auto& [direct, diffuse] :
             {std::pair{500.0, 100.0}, std::pair{0.0, 80.0}, std::pair{700.0, 20.0}}) {
            const Daylight light = spectra.from_parts(direct, diffuse, unit);
            const SpectralSpan span = span_of(unit);
            EXPECT_NEAR(spectra.direct(span) * light.direct, direct, 1e-9);
            EXPECT_NEAR(spectra.diffuse(span, light), diffuse, 1e-9);
        }
        const Daylight split = spectra.from_fraction(300, unit, .3);
        EXPECT_NEAR(split.diffuse, .3 * split.global(), 1e-9);
    }
}

TEST(Daylight, HasABlueClearSkyAndGreyClouds) {
    const DaylightSpectra spectra;
    const SpectralSpan blue{400, 500};
    const SpectralSpan red{655, 665};
    const auto colour = [&](const Daylight& light) {
        return spectra.diffuse(blue, light) / spectra.diffuse(red, light);
    };
    const double clear = colour({880, 120});
    const double overcast = colour({0, 300});
    const double global = reference_global().within(blue) / reference_global().within(red);
    EXPECT_NEAR(overcast, global, 1e-9);
    EXPECT_GT(clear, 1.5 * global);
    EXPECT_NEAR(colour({990, 10}), colour({900, 100}), 1e-9) << "no bluer than the standard's";
    for (const Daylight& light : {Daylight{990, 10}, Daylight{500, 500}, Daylight{0, 3}}) {
        for (double nm = 300; nm < 2500; nm += 20) {
            EXPECT_GE(spectra.diffuse({nm, nm + 20}, light), 0) << nm;
        }
    }
}

/// Red to far red of daylight: 1.1 to 1.3 in photons (Smith 1982).
TEST(Daylight, HasTheRedToFarRedRatioOfTheSun) {
    const DaylightSpectra spectra;
    const Daylight light{700, 200};
    const auto photons = [&](std::string_view band) {
        SpectralSpan span = *span_of_band(band);
        span.count = SpectralSpan::Count::photons;
        return spectra.direct(span) * light.direct + spectra.diffuse(span, light);
    };
    EXPECT_NEAR(photons("R") / photons("far_red"), 1.15, .1);
    EXPECT_FALSE(span_of_band("infra"));
}

/// Values computed from the published polynomials by hand; and that the pieces meet.
TEST(DiffuseFraction, FollowsErbs) {
    EXPECT_DOUBLE_EQ(diffuse_fraction_erbs(.1), .991);
    EXPECT_NEAR(diffuse_fraction_erbs(.5), .65915, 2e-4);
    EXPECT_DOUBLE_EQ(diffuse_fraction_erbs(.9), .165);
    EXPECT_NEAR(diffuse_fraction_erbs(.22), diffuse_fraction_erbs(.22 + 1e-9), 1e-3);
    EXPECT_NEAR(diffuse_fraction_erbs(.8), diffuse_fraction_erbs(.8 + 1e-9), 1e-3);
}

TEST(DiffuseFraction, FollowsReindl) {
    EXPECT_NEAR(diffuse_fraction_reindl(.2, .5), 1.020 - .0508 + .00615, 1e-12);
    EXPECT_NEAR(diffuse_fraction_reindl(.5, .5), 1.4 - .8745 + .0885, 1e-12);
    EXPECT_NEAR(diffuse_fraction_reindl(.85, .9), .4131 - .1638, 1e-12);
    EXPECT_EQ(diffuse_fraction_reindl(0, 1), 1) << "at most all of it";
    EXPECT_EQ(diffuse_fraction_reindl(.3 + 1e-9, .9), .97);
    EXPECT_EQ(diffuse_fraction_reindl(.78, 1), .486 * .78 - .182);
}

TEST(DiffuseFraction, FollowsSpitters) {
    EXPECT_EQ(diffuse_fraction_spitters(.2, .5), 1);
    EXPECT_NEAR(diffuse_fraction_spitters(.3, .5), 1 - 6.4 * .0064, 1e-12);
    EXPECT_NEAR(diffuse_fraction_spitters(.5, .5), 1.47 - .83, 1e-12);
    EXPECT_NEAR(diffuse_fraction_spitters(.9, .5), .847 - .805 + .26, 1e-12);
    EXPECT_NEAR(
        diffuse_fraction_spitters(.35, .5), diffuse_fraction_spitters(.35 + 1e-9, .5), .005);
}

TEST(DiffuseFraction, StaysBetweenNoneAndAll) {
    for (const DiffuseModel model :
         {DiffuseModel::erbs, DiffuseModel::reindl, DiffuseModel::spitters}) {
        for (double k = 0; k < 1.2; k += .01) {
            for (double sine = .02; sine <= 1; sine += .02) {
                const double fraction = diffuse_fraction(model, k, sine);
                EXPECT_GE(fraction, .09);
                EXPECT_LE(fraction, 1);
            }
        }
    }
}

/// Kasten and Young (1989), table II: 1.9939 at 30 degrees, 5.5841 at 10, 26.3079 at 1, 38 at 0.
TEST(ClearSky, HasThePublishedAirMasses) {
    EXPECT_NEAR(relative_air_mass(90), 1, 5e-4);
    EXPECT_NEAR(relative_air_mass(30), 1.9939, 1e-3);
    EXPECT_NEAR(relative_air_mass(10), 5.5841, 5e-3);
    EXPECT_NEAR(relative_air_mass(0), 38, .1);
}

/// Sun at a zenith angle of 10 degrees, absolute air mass 1, turbidity 3, 1364 W m-2 outside: the
/// numbers that the tests of pvlib (Holmgren, Hansen and Mikofski 2018) have for this model.
TEST(ClearSky, HasThePublishedNumbersOfIneichenAndPerez) {
    const Daylight light = clear_sky(
        80, 1364, {.linke_turbidity = 3, .pressure_hpa = 1013.25 / relative_air_mass(80)});
    EXPECT_NEAR(light.global(), 1038.159219, 1e-5);
    EXPECT_NEAR(light.direct / std::cos(10 * std::numbers::pi / 180), 942.2081860378344, 1e-6);
    EXPECT_NEAR(light.diffuse, 110.26529293612793, 1e-5);
}

TEST(ClearSky, FollowsIneichenAndPerez) {
    const Daylight clean = clear_sky(60, 1360, {.linke_turbidity = 1});
    const double sine = std::sin(60 * std::numbers::pi / 180);
    EXPECT_LE(clean.direct, .827 * 1360 * sine);
    const Daylight rural = clear_sky(60, 1360, {.linke_turbidity = 3});
    const Daylight hazy = clear_sky(60, 1360, {.linke_turbidity = 6});
    EXPECT_GT(clean.global(), rural.global());
    EXPECT_GT(rural.global(), hazy.global());
    EXPECT_LT(clean.diffuse, rural.diffuse);
    EXPECT_LT(rural.diffuse, hazy.diffuse);
    EXPECT_NEAR(rural.global() / (1360 * sine), .75, .03);
    const Daylight mountain =
        clear_sky(60, 1360, {.linke_turbidity = 3, .elevation_m = 2500, .pressure_hpa = 750});
    EXPECT_GT(mountain.direct, rural.direct);
}

TEST(ClearSky, IsDarkByNightAndContinuousAtSunrise) {
    EXPECT_EQ(clear_sky(0, 1360, {}).global(), 0);
    EXPECT_EQ(clear_sky(-10, 1360, {}).global(), 0);
    EXPECT_LT(clear_sky(.01, 1360, {}).global(), .2);
    for (double elevation = .1; elevation < 90; elevation += .1) {
        const Daylight light = clear_sky(elevation, 1360, {});
        EXPECT_GE(light.direct, 0);
        EXPECT_GT(light.diffuse, 0);
    }
}

}  // namespace
}  // namespace quasimc::test

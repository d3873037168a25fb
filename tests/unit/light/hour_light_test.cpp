#include "light/daylight/hour_light.h"

#include <cmath>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

const Site kWageningen{.latitude_deg = 51.97, .longitude_deg = 5.67};
const Site kSvalbard{.latitude_deg = 78.2, .longitude_deg = 15.6};

HourSources sources_of(const SunPath& path, const HourLight& light, const DaylightSources& how) {
    return make_hour_sources(make_hour_parts(path, light, how));
}

CivilTime june(int hour, int minute = 0) {
    return {2024, 6, 21, hour, minute, 0, 1};
}

DaylightSources to_sources() {
    DaylightSources how;
    how.bands = {{400, 700}};
    return how;
}

/// Irradiance of the sources on the horizontal, band 0.
double on_the_horizontal(const HourSources& hour) {
    double sum = 0;
    for (const auto& source : hour.sources) {
        sum += source->spectrum()[0] * source->horizontal_irradiance();
    }
    return sum;
}

HourLight light_of_reading(const SunPath& path, const Reading& reading) {
    return measured_light(
        path, reading, LightUnit::full_spectrum, DiffuseModel::erbs, DaylightSpectra());
}

TEST(SunPath, LooksAtTheMiddlesOfItsSteps) {
    const SunPath hour = sun_path(kWageningen, june(9), 3600, 300);
    ASSERT_EQ(hour.steps.size(), 12U);
    EXPECT_NEAR(
        hour.steps[3].elevation_deg,
        sun_position(kWageningen, {2024, 6, 21, 9, 17, 30, 1}).elevation_deg, 1e-6);
    EXPECT_EQ(sun_path(kWageningen, june(9), 0, 300).steps.size(), 1U);
    const SunPath still = sun_path(kWageningen, june(9), 3600, 0);
    ASSERT_EQ(still.steps.size(), 1U);
    EXPECT_NEAR(
        still.steps[0].azimuth_deg, sun_position(kWageningen, june(9, 30)).azimuth_deg, 1e-6);
}

TEST(SunPath, CountsOnlyTheTimeThatTheSunIsUp) {
    // Sunrise is at about 4:18 of UTC+1.
    const SunPath dawn = sun_path(kWageningen, june(4), 3600, 60);
    EXPECT_LT(dawn.steps.front().elevation_deg, 0);
    EXPECT_GT(dawn.steps.back().elevation_deg, 0);
    EXPECT_TRUE(SunPath::is_up(dawn.middle()));
    EXPECT_GT(dawn.mean_sine(), 0);
    const SunPath night = sun_path(kWageningen, june(0), 3600, 60);
    EXPECT_EQ(night.mean_sine(), 0);
    EXPECT_LT(night.highest_deg(), 0);
}

TEST(MeasuredLight, KeepsWhatWasMeasured) {
    const SunPath path = sun_path(kWageningen, june(10), 3600, 300);
    const double sine = path.mean_sine();
    const auto expect = [](const HourLight& light, double direct, double diffuse) {
        EXPECT_EQ(light.fault, ReadingFault::none);
        EXPECT_EQ(light.note, ReadingNote::none);
        EXPECT_NEAR(light.daylight.direct, direct, 1e-9);
        EXPECT_NEAR(light.daylight.diffuse, diffuse, 1e-9);
    };
    expect(light_of_reading(path, {.direct_horizontal = 400, .diffuse = 150}), 400, 150);
    expect(light_of_reading(path, {.beam_normal = 500, .diffuse = 150}), 500 * sine, 150);
    expect(light_of_reading(path, {.global = 550, .diffuse = 150}), 400, 150);
    expect(light_of_reading(path, {.global = 550, .direct_horizontal = 400}), 400, 150);
    expect(light_of_reading(path, {.global = 550, .beam_normal = 400 / sine}), 400, 150);
    const HourLight split = light_of_reading(path, {.global = 550});
    EXPECT_NEAR(split.daylight.global(), 550, 1e-9);
    const double fraction = diffuse_fraction_erbs(550 / (path.outside() * sine));
    EXPECT_NEAR(split.daylight.diffuse, 550 * fraction, 1e-9);
}

TEST(MeasuredLight, BringsToTheHorizontalWhatItSays) {
    for (const int hour : {4, 5, 12, 19}) {
        for (const double step : {0.0, 300.0, 3600.0}) {
            const SunPath path = sun_path(kWageningen, june(hour), 3600, step);
            if (path.mean_sine() == 0) {
                continue;
            }
            const HourLight light = light_of_reading(
                path, {.direct_horizontal = 300 * path.mean_sine(), .diffuse = 100});
            const DaylightSources how = to_sources();
            const double expected = how.spectra.direct(how.bands[0]) * light.daylight.direct +
                                    how.spectra.diffuse(how.bands[0], light.daylight);
            EXPECT_NEAR(on_the_horizontal(sources_of(path, light, how)), expected, 1e-6 * expected);
        }
    }
}

TEST(MeasuredLight, TellsWhatCantBe) {
    const SunPath noon = sun_path(kWageningen, june(12), 3600, 300);
    EXPECT_EQ(light_of_reading(noon, {}).fault, ReadingFault::incomplete);
    EXPECT_EQ(light_of_reading(noon, {.diffuse = 3}).fault, ReadingFault::incomplete);
    EXPECT_EQ(
        light_of_reading(noon, {.global = 100, .direct_horizontal = 200}).fault,
        ReadingFault::part_exceeds_global);
    EXPECT_EQ(
        light_of_reading(noon, {.global = 100, .direct_horizontal = 105}).note,
        ReadingNote::more_direct_than_global);
    const SunPath night = sun_path(kWageningen, june(0), 3600, 300);
    EXPECT_EQ(light_of_reading(night, {.global = 300}).fault, ReadingFault::light_at_night);
    EXPECT_EQ(light_of_reading(night, {.global = 2}).fault, ReadingFault::none)
        << "an offset of a sensor";
}

/// Thermopiles read some W m-2 below zero at night, each of its own.
TEST(MeasuredLight, TakesOffsetsOfInstrumentsForDarkness) {
    const SunPath night = sun_path(kWageningen, june(0), 3600, 300);
    const std::vector<Reading> readings{
        {.global = -2},
        {.global = -2, .diffuse = -2},
        {.global = -2, .diffuse = -1},
        {.global = -1, .diffuse = -2},
        {.global = -2, .diffuse = 0},
        {.global = 0, .diffuse = -2},
        {.global = 0, .diffuse = .5},
        {.beam_normal = -.5, .diffuse = -3},
        {.direct_horizontal = -1, .diffuse = 0}};
    for (const Reading& reading : readings) {
        const HourLight light = light_of_reading(night, reading);
        EXPECT_EQ(light.fault, ReadingFault::none);
        EXPECT_EQ(light.note, ReadingNote::none);
        EXPECT_EQ(light.daylight.global(), 0);
    }
    EXPECT_EQ(light_of_reading(night, {.global = -99}).fault, ReadingFault::negative);
}

TEST(MeasuredLight, IsDiffuseAtDuskWhereThatIsALittleMoreThanAll) {
    const SunPath dusk = sun_path(kWageningen, june(19), 3600, 300);
    const HourLight light = light_of_reading(dusk, {.global = 10, .diffuse = 12});
    EXPECT_EQ(light.fault, ReadingFault::none);
    EXPECT_EQ(light.note, ReadingNote::more_diffuse_than_global);
    EXPECT_EQ(light.daylight.direct, 0);
    EXPECT_EQ(light.daylight.diffuse, 10);
}

TEST(MeasuredLight, CountsABeamThatCantBeAsDiffuse) {
    for (const int hour : {4, 5}) {
        const SunPath dawn = sun_path(kWageningen, june(hour), 3600, 300);
        const double most = 2 * clear_light(dawn, {}).daylight.direct;
        const HourLight light =
            light_of_reading(dawn, {.direct_horizontal = 1.5 * most, .diffuse = 10});
        // The weakest beams of a day are measured too badly for a note.
        EXPECT_EQ(light.note, hour == 4 ? ReadingNote::none : ReadingNote::beam_too_strong);
        EXPECT_NEAR(light.daylight.direct, most, 1e-9);
        EXPECT_NEAR(light.daylight.diffuse, .5 * most + 10, 1e-9);
        const HourLight less =
            light_of_reading(dawn, {.direct_horizontal = .99 * most, .diffuse = 10});
        EXPECT_EQ(less.note, ReadingNote::none);
        EXPECT_NEAR(less.daylight.direct, .99 * most, 1e-9);
    }
    const SunPath night = sun_path(kWageningen, june(23), 3600, 300);
    EXPECT_EQ(light_of_reading(night, {.direct_horizontal = 9, .diffuse = 10}).daylight.direct, 0);
}

/// 20 W m-2 on the horizontal with the sun at 2 degrees for 25 minutes is no beam of 1310 W m-2.
TEST(MeasuredLight, HasNoBeamAtSunriseThatNoSkyLetsThrough) {
    const Site site{.latitude_deg = 40, .longitude_deg = 15};
    const SunPath sunrise = sun_path(site, {2024, 6, 21, 4, 0, 0, 1}, 3600, 300);
    ASSERT_GT(20 / sunrise.mean_sine(), 1000);
    const HourLight light = light_of_reading(sunrise, {.direct_horizontal = 20, .diffuse = 10});
    const HourLight clear = clear_light(sunrise, {});
    EXPECT_NEAR(light.daylight.direct, 2 * clear.daylight.direct, 1e-9);
    EXPECT_LT(light.facing.back(), 150);
    EXPECT_NEAR(light.daylight.global(), 30, 1e-9) << "no light is lost";
}

TEST(MeasuredLight, IsNothingAtNightAndNeverBelowZeroByDay) {
    const SunPath night = sun_path(kWageningen, june(0), 3600, 300);
    const HourLight dark = light_of_reading(night, {.global = 3});
    EXPECT_EQ(dark.daylight.global(), 0);
    EXPECT_EQ(dark.note, ReadingNote::light_at_night);
    const SunPath dusk = sun_path(kWageningen, june(20), 3600, 300);
    EXPECT_NEAR(light_of_reading(dusk, {.global = 3}).daylight.global(), 3, 1e-9);
    const SunPath noon = sun_path(kWageningen, june(12), 3600, 300);
    EXPECT_EQ(light_of_reading(noon, {.global = -7}).note, ReadingNote::negative_by_day);
    EXPECT_EQ(
        light_of_reading(noon, {.beam_normal = -1, .diffuse = -7}).note,
        ReadingNote::negative_by_day);
    EXPECT_EQ(light_of_reading(noon, {.beam_normal = -1, .diffuse = 300}).note, ReadingNote::none)
        << "the beam of an overcast noon";
}

TEST(MeasuredLight, TellsOfReadingsThatDisagree) {
    const SunPath path = sun_path(kWageningen, june(10), 3600, 300);
    const double sine = path.mean_sine();
    const auto note = [&](const Reading& reading) {
        const HourLight light = light_of_reading(path, reading);
        EXPECT_EQ(light.fault, ReadingFault::none);
        return light.note;
    };
    const Reading agreed{.global = 560, .direct_horizontal = 400, .diffuse = 150};
    EXPECT_EQ(note(agreed), ReadingNote::none);
    EXPECT_EQ(
        note({.global = 500, .direct_horizontal = 700, .diffuse = 200}),
        ReadingNote::parts_disagree);
    EXPECT_EQ(
        note({.global = 500, .beam_normal = 700 / sine, .diffuse = 200}),
        ReadingNote::parts_disagree);
    EXPECT_EQ(
        note({.direct_horizontal = 200, .beam_normal = 500, .diffuse = 100}),
        ReadingNote::parts_disagree);
    EXPECT_EQ(
        note({.direct_horizontal = 1500, .diffuse = 100}), ReadingNote::more_direct_than_outside);
}

/// An hour's mean of the clear sky converges with the steps; a frozen sun is off.
TEST(ClearLight, ConvergesWithTheStepsOfTheSun) {
    const auto global = [](double step) {
        return clear_light(sun_path(kWageningen, june(5), 3600, step), {}).daylight.global();
    };
    const double fine = global(10);
    EXPECT_NEAR(global(300), fine, 5e-4 * fine);
    EXPECT_GT(std::abs(global(0) - fine), std::abs(global(300) - fine));
}

/// FAO 56 (Allen et al. 1998), eq. 37, has 0.75 of the 41.8 MJ m-2 outside the atmosphere for any
/// clear day of June at 52 degrees north; a turbidity of 3 is a little more than that of clean air.
TEST(ClearLight, AddsUpToAClearDay) {
    double sum = 0;
    for (int hour = 0; hour < 24; ++hour) {
        sum += 3600e-6 *
               clear_light(sun_path(kWageningen, june(hour), 3600, 300), {}).daylight.global();
    }
    EXPECT_NEAR(sum, .75 * 41.8, .1 * 31);
}

TEST(ClearLight, ShinesAllDayAndNotAtAllAtThePoles) {
    for (int hour = 0; hour < 24; ++hour) {
        const CivilTime december{2024, 12, 21, hour, 0, 0, 1};
        EXPECT_GT(clear_light(sun_path(kSvalbard, june(hour), 3600, 300), {}).daylight.direct, 0);
        const SunPath night = sun_path(kSvalbard, december, 3600, 300);
        const HourLight dark = clear_light(night, {});
        EXPECT_EQ(dark.daylight.global(), 0);
        EXPECT_TRUE(sources_of(night, dark, to_sources()).sources.empty());
    }
}

TEST(HourSources, AreSunsAndOneSky) {
    const SunPath path = sun_path(kWageningen, june(10), 3600, 300);
    const HourSources clear = sources_of(
        path, light_of_reading(path, {.direct_horizontal = 300, .diffuse = 80}), to_sources());
    ASSERT_EQ(clear.sources.size(), 13U);
    for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_TRUE(clear.sources[i]->is_directional());
    }
    EXPECT_FALSE(clear.sources[12]->is_directional());
}

/// All overcast skies are alike, so that only one of them needs to be traced.
TEST(HourSources, OfOvercastTimesHaveTheSameShape) {
    const SunPath ten = sun_path(kWageningen, june(10), 3600, 300);
    const SunPath two = sun_path(kWageningen, june(14), 3600, 300);
    const auto shapes = [](const SunPath& path, const Reading& reading) {
        return sources_of(path, light_of_reading(path, reading), to_sources()).directional_key;
    };
    EXPECT_EQ(
        shapes(ten, {.direct_horizontal = 0, .diffuse = 80}),
        shapes(two, {.direct_horizontal = 0, .diffuse = 200}));
    EXPECT_NE(
        shapes(ten, {.direct_horizontal = 9, .diffuse = 80}),
        shapes(two, {.direct_horizontal = 9, .diffuse = 80}));
}

}  // namespace
}  // namespace quasimc::test

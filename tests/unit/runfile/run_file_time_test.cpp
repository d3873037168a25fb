#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "light/daylight/solar_reference.h"
#include "quasimc/series.h"
#include "unit/runfile/time_testing.h"

namespace quasimc::test {
namespace {

TimeSeries series_of(const std::string& keys, const FakeFiles& files = {}) {
    return *read_text(with_time(keys), files).series;
}

/// Light on the horizontal in a time step, band 0.
double on_the_horizontal(const TimeStep& time_step) {
    double sum = 0;
    for (const auto& source : time_step.sources) {
        sum += source->spectrum()[0] * source->horizontal_irradiance();
    }
    return sum;
}

TEST(RunFileTime, OfADayIsItsHours) {
    const TimeSeries day = series_of("day = '2024-06-21'\nutc_offset_hours = 2\n");
    ASSERT_EQ(day.time_steps.size(), 24U);
    EXPECT_EQ(day.days, std::vector<std::string>{"2024-06-21"});
    EXPECT_EQ(day.notes[12].time, "2024-06-21T12:00+02:00");
    EXPECT_EQ(day.time_steps[12].seconds, 3600);
    EXPECT_TRUE(day.time_steps[0].sources.empty()) << "night";
    EXPECT_EQ(day.time_steps[13].sources.size(), 13U) << "a sun every 5 minutes, and the sky";
    EXPECT_EQ(day.notes[13].suns, 12U);
    // PAR is 43 % of a clear noon's 870 W m-2.
    EXPECT_NEAR(on_the_horizontal(day.time_steps[13]), .43 * 870, 20);
}

TEST(RunFileTime, OfASeasonIsItsDaysAndHoursAskedFor) {
    const TimeSeries season = series_of(
        "from = '2024-02-28'\nto = '2024-03-01'\nhours = [9, 15]\nstep_minutes = 120\n"
        "sun_step_minutes = 0\nutc_offset_hours = 1\n");
    EXPECT_EQ(season.days, (std::vector<std::string>{"2024-02-28", "2024-02-29", "2024-03-01"}));
    ASSERT_EQ(season.time_steps.size(), 9U);
    EXPECT_EQ(season.notes[3].time, "2024-02-29T09:00+01:00");
    EXPECT_EQ(season.time_steps[3].day, 1U);
    EXPECT_EQ(season.time_steps[0].seconds, 7200);
    EXPECT_EQ(season.notes[4].suns, 1U) << "one sun in the middle";
}

TEST(RunFileTime, OfTimesMayHaveAmountsInAnyUnit) {
    const std::string times = "times = ['2024-06-21T13:40+02:00', '2024-06-21T09:00+02:00']\n";
    const TimeSeries clear = series_of(times);
    ASSERT_EQ(clear.time_steps.size(), 2U);
    EXPECT_EQ(clear.notes[0].time, "2024-06-21T09:00+02:00") << "in order";
    EXPECT_EQ(clear.time_steps[0].seconds, 0);
    RunText text;
    text.top = "[[band]]\nname = 'PAR'\nunit = 'umol m-2 s-1'\n";
    text.sources = "";
    text.rest = std::string(kSite) + "[time]\n" + times + "global = [1500, 200]\nunit = 'PPFD'\n";
    const RunFile run = read_text(text.text());
    // In the order of the times as given.
    EXPECT_NEAR(on_the_horizontal(run.series->time_steps[1]), 1500, 1e-6 * 1500);
    EXPECT_NEAR(on_the_horizontal(run.series->time_steps[0]), 200, 1e-6 * 200);
}

TEST(RunFileTime, SplitsLightIntoBandsByTheirWavelengths) {
    RunText text;
    text.top =
        "[[band]]\nname = 'mine'\nfrom_nm = 655\nto_nm = 665\n[[band]]\nname = 'red'\n"
        "[[band]]\nname = 'R'\nunit = 'umol m-2 s-1'\n";
    text.sources = "";
    text.rest = std::string(kSite) + "[time]\ntimes = ['2024-06-21T13:40+02:00']\n";
    const RunFile run = read_text(text.text());
    const auto spectrum = run.series->time_steps[0].sources[0]->spectrum();
    EXPECT_DOUBLE_EQ(spectrum[0], spectrum[1]);
    EXPECT_NEAR(spectrum[2] / spectrum[1], 660 * 8.3593e-3, .01);
    text.top = "bands = ['green stuff']\n";
    EXPECT_TRUE(mentions(faults_of(text.text()), "the wavelengths of band 'green stuff'"));
    text.top = "[[band]]\nname = 'PAR'\nunit = 'klm'\n";
    EXPECT_TRUE(mentions(faults_of(text.text()), "daylight is available in W m-2"));
}

TEST(RunFileTime, TakesSpectraOfOnesOwn) {
    const FakeFiles files{
        {"s.csv",
         "# mine\nwavelength_nm,direct,diffuse\n299,0,0\n300,1,0\n500,1,2\n700,1,0\n701,0,0\n"}};
    RunText text;
    text.top = "[[band]]\nname = 'low'\nfrom_nm = 300\nto_nm = 500\n";
    text.sources = "";
    text.rest = std::string(kSite) +
                "[time]\ntimes = ['2024-06-21T13:40+02:00']\nspectrum = 's.csv'\n"
                "direct_horizontal = 400\ndiffuse = 100\n";
    const RunFile run = read_text(text.text(), files);
    // Direct light is a rectangle with sides of 1 nm.
    EXPECT_NEAR(on_the_horizontal(run.series->time_steps[0]), 200 / 401.0 * 400 + .5 * 100, 1e-6);
    const auto bad = faults_of(
        text.text(), {{"s.csv", "wavelength_nm,direct,diffuse\n300,1\n300,1,0\n300,1,0\nx,1,1\n"}});
    EXPECT_EQ(bad.size(), 2U) << "one line for each kind of fault";
    EXPECT_TRUE(mentions(bad, "does not increase"));
    EXPECT_TRUE(mentions(bad, "s.csv:2: is not a row of a spectrum"));
    EXPECT_TRUE(mentions(bad, "; 1 more row with this error"));
    EXPECT_TRUE(mentions(
        faults_of(text.text(), {{"s.csv", "nm,a\n"}}), "names of the columns are missing"));
    EXPECT_TRUE(mentions(
        faults_of(text.text(), {{"s.csv", "wavelength_nm,direct,diffuse\n4,0,0\n5,0,0\n"}}),
        "no light"));
}

/// The standard's spectrum as measured by a spectrometer with steps of `step_nm`.
std::string measured_spectrum(int from_nm, int to_nm, int step_nm = 10) {
    std::string text = "wavelength_nm,direct,diffuse\n";
    for (int nm = from_nm; nm <= to_nm; nm += step_nm) {
        const double low = std::max<double>(280, nm - .5 * step_nm);
        const double high = std::min<double>(4000, nm + .5 * step_nm);
        text += fmt::format(
            "{},{},{}\n", nm, reference_direct().within({low, high}) / (high - low),
            reference_global().within({low, high}) / (high - low));
    }
    return text;
}

/// PAR and NIR of a clear noon of that spectrum.
struct NoonLight {
    double par = 0, nir = 0;
    std::string warnings;
};
NoonLight noon_of(const std::string& spectrum) {
    RunText text;
    text.top = "bands = ['PAR', 'NIR']\n";
    text.sources = "";
    text.rest = std::string(kSite) + "[time]\ntimes = ['2024-06-21T12:00Z']\nspectrum = 's.csv'\n";
    const RunFile run = read_text(text.text(), {{"s.csv", spectrum}});
    NoonLight light;
    for (const auto& source : run.series->time_steps[0].sources) {
        light.par += source->spectrum()[0] * source->horizontal_irradiance();
        light.nir += source->spectrum()[1] * source->horizontal_irradiance();
    }
    for (const Warning& warning : run.warnings) {
        light.warnings += warning.where + ": " + warning.text + "\n";
    }
    return light;
}

TEST(RunFileTime, TakesTheStandardsLightOutsideAShortSpectrum) {
    const NoonLight whole = noon_of(measured_spectrum(280, 4000));
    EXPECT_EQ(whole.warnings.find("s.csv"), std::string::npos) << whole.warnings;
    for (const auto& [from, to] : {std::pair(400, 1100), {400, 700}, {350, 2500}, {300, 1000}}) {
        const NoonLight part = noon_of(measured_spectrum(from, to));
        EXPECT_NEAR(part.par, whole.par, .01 * whole.par) << from;
        EXPECT_NEAR(part.nir, whole.nir, .02 * whole.nir) << from;
        EXPECT_NE(
            part.warnings.find(fmt::format(
                "s.csv: the rows cover {} to {} nm, daylight 280 to 4000 nm", from, to)),
            std::string::npos)
            << part.warnings;
    }
    // A row of 0 says that there is no more light.
    const std::string lamp = "wavelength_nm,direct,diffuse\n399,0,0\n400,1,1\n700,1,1\n701,0,0\n";
    const NoonLight dark = noon_of(lamp);
    EXPECT_NEAR(dark.nir / dark.par, .5 / 300, 1e-9) << "the side of the rectangle";
    EXPECT_NE(dark.warnings.find("0 % of the direct"), std::string::npos) << dark.warnings;
    EXPECT_NE(
        noon_of("wavelength_nm,direct,diffuse\n280,0,0\n400,1,1\n650,1,1\n699,0,0\n4000,0,0\n")
            .warnings.find("daylight has no light in band 'NIR', 700 to 2500 nm"),
        std::string::npos);
}

TEST(RunFileTime, LampsShineAtAllTimes) {
    RunText text;
    text.sources = "[[source]]\ntype = 'point'\nposition = [0, 0, 3]\npower = 9\n";
    text.rest =
        std::string(kSite) + "[time]\nday = '2024-06-21'\nutc_offset_hours = 1\nsky = 'uniform'\n";
    const RunFile run = read_text(text.text());
    EXPECT_EQ(run.sources.size(), 1U);
    EXPECT_EQ(run.series->time_steps[0].sources.size(), 1U);
    EXPECT_EQ(run.series->time_steps[12].sources.size(), 14U);
    const auto plans = plan_series(run.series->time_steps);
    EXPECT_EQ(plans[23].traced, 0U) << "all night alike";
}

TEST(RunFileTime, SaysWhatIsMissingOrWrong) {
    const auto faults = [](const std::string& keys) { return faults_of(with_time(keys)); };
    EXPECT_TRUE(mentions(faults("utc_offset_hours = 1\n"), "the times are missing"));
    EXPECT_TRUE(mentions(faults("day = '2024-06-21'\n"), "utc_offset_hours"));
    EXPECT_TRUE(mentions(
        faults("day = '2024-06-21'\nfrom = '2024-06-21'\nutc_offset_hours = 1\n"), "both day"));
    EXPECT_TRUE(mentions(
        faults("from = '2024-06-21'\nto = '2024-06-20'\nutc_offset_hours = 1\n"), "before from"));
    EXPECT_TRUE(mentions(faults("from = '2024-06-21'\nutc_offset_hours = 1\n"), "to"));
    EXPECT_TRUE(mentions(
        faults("day = '2023-02-29'\nutc_offset_hours = 1\n"), "month 2 of 2023 has 28 days"));
    EXPECT_TRUE(
        mentions(faults("day = '2024-06-21'\nutc_offset_hours = 15\n"), "utc_offset_hours"));
    EXPECT_TRUE(mentions(faults("times = ['2024-06-21T12:00']\n"), "has no time zone"));
    EXPECT_TRUE(mentions(faults("times = []\n"), "times is empty"));
    EXPECT_TRUE(mentions(
        faults("times = ['2024-06-21T12:00Z']\nglobal = [1, 2]\n"), "global has 2 values"));
    EXPECT_TRUE(mentions(faults("times = ['2024-06-21T12:00Z']\ndiffuse = 5\n"), "is unknown"));
    EXPECT_TRUE(mentions(
        faults("times = ['2024-06-21T12:00Z']\nsky = 'cloudy'\n"), "sky: 'cloudy' is not one of"));
    EXPECT_TRUE(
        mentions(faults("day = '2024-06-21'\nutc_offset_hours = 1\nhours = [9]\n"), "not a pair"));
    EXPECT_TRUE(
        mentions(faults("day = '2024-06-21'\nutc_offset_hours = 1\nhors = [9, 10]\n"), "hours"));
    EXPECT_TRUE(
        mentions(faults_of(with_time("times = ['2024-06-21T12:00Z']\n", "")), "[site] is missing"));
    EXPECT_TRUE(mentions(
        faults_of(with_time("times = ['2024-06-21T12:00Z']\n", "[site]\nlatitude_deg = 91\n")),
        "latitude_deg"));
}

/// A sun below the horizon at all times is reported, night or polar night; a polar day has light.
TEST(RunFileTime, ReportsNightAndPolarNight) {
    const auto tells_night = [](const std::string& text) {
        const RunFile run = read_text(text);
        return std::any_of(run.warnings.begin(), run.warnings.end(), [](const Warning& warning) {
            return warning.text.find("it is night at all time steps") != std::string::npos;
        });
    };
    EXPECT_TRUE(tells_night(with_time("times = ['2024-06-21T00:00+01:00']\n")));
    EXPECT_FALSE(tells_night(with_time("times = ['2024-06-21T12:00+01:00']\n")));
    const std::string svalbard = "[site]\nlatitude_deg = 78.2\nlongitude_deg = 15.6\n";
    const std::string day = "day = '2024-12-21'\nutc_offset_hours = 1\n";
    EXPECT_TRUE(tells_night(with_time(day, svalbard)));
    const RunFile summer = read_text(
        with_time("day = '2024-06-21'\nutc_offset_hours = 1\nsky = 'uniform'\n", svalbard));
    for (const TimeStep& time_step : summer.series->time_steps) {
        EXPECT_FALSE(time_step.sources.empty());
    }
}

/// A sky that is taken for part of a day's light shines at night too; a lamp, and what has hours,
/// may.
TEST(RunFileTime, WarnsOfDaylightBesideThatOfTheTimes) {
    const auto warnings = [](const std::string& source) {
        std::string texts;
        for (const Warning& warning :
             read_text(with_time("times = ['2024-06-21T12:00+01:00']\n") + source).warnings) {
            texts += warning.text.find("daylight as well") != std::string::npos ? warning.text : "";
        }
        return texts;
    };
    const std::string sky =
        "[[source]]\nname = 'upper'\ntype = 'uniform_sky'\nirradiance_horizontal = 5\n";
    EXPECT_NE(warnings(sky).find("daylight as well: 'upper'"), std::string::npos);
    EXPECT_EQ(warnings(sky + "on_hours = [4, 20]\n"), "");
    EXPECT_EQ(warnings("[[source]]\ntype = 'point'\nposition = [0, 0, 9]\npower = 5\n"), "");
}

TEST(RunFileTime, WarnsOfTimesThatOverlap) {
    const auto overlap_warnings = [](const std::string& keys) {
        std::string texts;
        for (const Warning& warning : read_text(with_time(keys)).warnings) {
            texts += warning.text.find("overlap") != std::string::npos ? warning.text : "";
        }
        return texts;
    };
    const std::string times =
        "times = ['2024-06-21T12:00+01:00', '2024-06-21T11:30+01:00', '2024-06-21T13:00+01:00']\n";
    EXPECT_NE(
        overlap_warnings(times + "duration_minutes = 60\n")
            .find("1 of the time steps overlap, and daily sums count their light twice: "
                  "2024-06-21T12:00+01:00 begins 30 min after 2024-06-21T11:30+01:00, which lasts "
                  "60 min"),
        std::string::npos)
        << overlap_warnings(times + "duration_minutes = 60\n");
    EXPECT_EQ(overlap_warnings(times + "duration_minutes = 30\n"), "");
    EXPECT_EQ(overlap_warnings(times), "");
}

TEST(RunFileTime, WarnsOfAClockFromElsewhere) {
    const RunFile run = read_text(with_time(
        "times = ['2024-06-21T12:00-07:00']\nutc_offset_hours = -7\n",
        "[site]\nlatitude_deg = 80\nlongitude_deg = 105.2\n"));
    ASSERT_FALSE(run.warnings.empty());
    EXPECT_NE(run.warnings[0].text.find("sign of the longitude"), std::string::npos);
}

/// A day of a table, half-hourly, bright by day.
std::string day_table(int from_hour = 0, int to_hour = 24) {
    std::string text = "time,global,diffuse\n";
    for (int i = 2 * from_hour; i < 2 * to_hour; ++i) {
        const double hour = (i + .5) / 2;
        const double light =
            std::max(0.0, 600 * std::cos((hour - 12.6) / 24 * 2 * std::numbers::pi) - 100);
        text += fmt::format(
            "2024-06-21T{:02d}:{:02d}+01:00,{:.2f},{:.2f}\n", i / 2, i % 2 * 30, light, .3 * light);
    }
    return text;
}

TEST(RunFileWeather, GivesTheLightOfATable) {
    const TimeSeries series =
        series_of("weather = 'w.csv'\nstamp = 'start'\n", {{"w.csv", day_table()}});
    ASSERT_EQ(series.time_steps.size(), 48U);
    EXPECT_EQ(series.time_steps[0].seconds, 1800);
    const TimeStepNotes& noon = series.notes[24];
    EXPECT_EQ(noon.time, "2024-06-21T12:00+01:00");
    EXPECT_NEAR(noon.daylight.diffuse / noon.daylight.global(), .3, 1e-4);
    const TimeSeries some = series_of(
        "weather = 'w.csv'\nstamp = 'start'\nday = '2024-06-21'\nhours = [10, 12]\n",
        {{"w.csv", day_table()}});
    EXPECT_EQ(some.time_steps.size(), 4U);
    EXPECT_EQ(some.notes[0].time, "2024-06-21T10:00+01:00") << "on the clock of the rows";
    EXPECT_EQ(
        series_of(
            "weather = 'w.csv'\nstamp = 'start'\nday = '2024-06-21'\n", {{"w.csv", day_table()}})
            .time_steps.size(),
        48U);
    EXPECT_TRUE(mentions(
        faults_of(
            with_time("weather = 'w.csv'\nday = '2024-06-23'\nutc_offset_hours = 1\n"),
            {{"w.csv", day_table()}}),
        "no light at the requested times"));
}

/// A clock twelve hours off puts light into the night.
TEST(RunFileWeather, NoticesAWrongTimeZone) {
    std::string shifted = day_table();
    for (std::size_t at = shifted.find("+01:00"); at != std::string::npos;
         at = shifted.find("+01:00", at)) {
        shifted.replace(at, 6, "-11:00");
    }
    const auto faults = faults_of(with_time("weather = 'w.csv'\n"), {{"w.csv", shifted}});
    EXPECT_TRUE(
        mentions(faults, "degrees below the horizon (the time zone, the site or stamp is wrong"));
    EXPECT_TRUE(mentions(faults, "with this error"));
    EXPECT_EQ(faults.size(), 1U);
}

/// Warnings of an hour at noon of midsummer with the given light.
std::vector<std::string> warnings_of_noon(const std::string& global, const std::string& unit) {
    std::vector<std::string> warnings;
    const std::string keys = "times = ['2024-06-21T12:00+01:00']\nduration_minutes = 60\n";
    for (const Warning& warning :
         read_text(with_time(keys + "global = " + global + "\nunit = '" + unit + "'\n")).warnings) {
        warnings.push_back(warning.where + ": " + warning.text);
    }
    return warnings;
}

TEST(RunFileTime, WarnsOfMoreLightThanTheSunBringsAndNamesTheUnit) {
    const auto beyond = "1 time has more light than the sun gives outside the atmosphere";
    EXPECT_FALSE(mentions(warnings_of_noon("1000", "full_spectrum"), beyond));
    EXPECT_FALSE(mentions(warnings_of_noon("1900", "PPFD"), beyond));
    EXPECT_FALSE(mentions(warnings_of_noon("100000", "lux"), beyond));
    EXPECT_TRUE(mentions(warnings_of_noon("1900", "full_spectrum"), beyond));
    EXPECT_TRUE(mentions(warnings_of_noon("1900", "full_spectrum"), "umol m-2 s-1"));
    EXPECT_TRUE(mentions(warnings_of_noon("100000", "full_spectrum"), "is it in lux"));
    EXPECT_TRUE(mentions(warnings_of_noon("3e6", "full_spectrum"), "is it in J m-2 an hour"));
    EXPECT_TRUE(mentions(warnings_of_noon("3e7", "full_spectrum"), "is it in J m-2 a day"));
    EXPECT_TRUE(mentions(warnings_of_noon("100000", "PPFD"), "is it in lux"));
}

TEST(RunFileWeather, OfDaysOfTheYearNeedsAYearAndAClock) {
    std::string table = "DOY;Hour;Rg;RdRg\n";
    for (int hour = 1; hour <= 24; ++hour) {
        table += fmt::format("172;{};{};0.5\n", hour, hour > 8 && hour < 17 ? 400 : 0);
    }
    const std::string keys =
        "weather = 'w.csv'\nyear = 2006\nutc_offset_hours = 1\n"
        "columns = { global = 'Rg', diffuse_fraction = 'RdRg' }\n";
    const TimeSeries series = series_of(keys, {{"w.csv", table}});
    ASSERT_EQ(series.time_steps.size(), 24U);
    EXPECT_EQ(series.notes[11].time, "2006-06-21T11:00+01:00");
    EXPECT_NEAR(series.notes[11].daylight.diffuse, 200, 1e-9);
    EXPECT_NEAR(series.notes[11].daylight.direct, 200, 1e-9);
}

TEST(RunFileWeather, ThatIsBrokenIsToldFirst) {
    RunText text;
    text.sources = "";
    text.rest = "[time]\nweather = 'w.epw'\nday = '2024-06-21'\n";
    const auto faults = faults_of(text.text(), {{"w.epw", "hello\n"}});
    ASSERT_EQ(faults.size(), 1U) << ::testing::PrintToString(faults);
    EXPECT_TRUE(mentions(faults, "w.epw:1: does not begin with LOCATION"));
}

TEST(RunFileWeather, GapsAreFaultsOrSkipped) {
    std::string holey = day_table();
    const std::size_t row = holey.find("2024-06-21T12:00");
    const std::size_t next = holey.find('\n', row) + 1;
    holey.erase(row, next - row);
    const std::size_t value = holey.find(',', holey.find("2024-06-21T14:00")) + 1;
    holey.replace(value, holey.find(',', value) - value, "NA");
    const std::string keys = "weather = 'w.csv'\nstamp = 'start'\n";
    const auto faults = faults_of(with_time(keys), {{"w.csv", holey}});
    EXPECT_EQ(faults.size(), 2U);
    EXPECT_TRUE(mentions(faults, "1 rows are missing from 2024-06-21T12:00+01:00"));
    EXPECT_TRUE(mentions(faults, "no light at 2024-06-21T14:00+01:00"));
    const RunFile run = read_text(with_time(keys + "gaps = 'skip'\n"), {{"w.csv", holey}});
    EXPECT_EQ(run.series->time_steps.size(), 46U);
    EXPECT_FALSE(run.warnings.empty());
    EXPECT_TRUE(mentions(
        faults_of(
            with_time(keys + "gaps = 'skip'\n"),
            {{"w.csv", "time,global\n2024-06-21T12:00+01:00,\n2024-06-21T13:00+01:00,\n"}}),
        "no requested time has light"));
    const std::string day = "day = '2024-06-21'\nutc_offset_hours = 1\n";
    EXPECT_TRUE(mentions(
        faults_of(with_time(keys + day), {{"w.csv", day_table(3, 20)}}),
        "6 rows are missing from 2024-06-21T00:00+01:00"));
    EXPECT_TRUE(mentions(
        faults_of(with_time(keys + day), {{"w.csv", day_table(3, 20)}}),
        "8 rows are missing from 2024-06-21T20:00+01:00"));
}

std::string epw_text(double zone = 1) {
    std::string text = fmt::format(
        "LOCATION,Wageningen,-,NLD,test,0,51.97,5.67,{},7.0\nDATA "
        "PERIODS,1,1,Data,Sunday,1/1,12/31\n",
        zone);
    for (const int month : {6, 7}) {
        for (int hour = 1; hour <= 24; ++hour) {
            const bool is_light = hour > 8 && hour < 18;
            text += fmt::format(
                "{},{},21,{},60,?,15,10,70,101325,0,0,300,0,{},{},0\n", month == 6 ? 1999 : 1985,
                month, hour, is_light ? 500 : 0, is_light ? 100 : 0);
        }
    }
    return text;
}

TEST(RunFileWeather, GivesTheSiteAndLightOfAnEpwFile) {
    RunText text;
    text.sources = "";
    text.rest = "[time]\nweather = 'w.epw'\nday = '2024-06-21'\n";
    const RunFile run = read_text(text.text(), {{"w.epw", epw_text()}});
    ASSERT_EQ(run.series->time_steps.size(), 24U);
    EXPECT_EQ(run.series->notes[12].time, "2024-06-21T12:00+01:00") << "of the year asked for";
    EXPECT_NEAR(run.series->notes[12].daylight.diffuse, 100, 1e-6);
    EXPECT_NEAR(
        run.series->notes[12].daylight.direct,
        500 * std::sin(run.series->notes[12].sun.elevation_deg * std::numbers::pi / 180), 5);
    text.rest = "[time]\nweather = 'w.epw'\nday = '2024-06-22'\n";
    EXPECT_TRUE(mentions(
        faults_of(text.text(), {{"w.epw", epw_text()}}), "no light at the requested times"));
    text.rest = "[time]\nweather = 'w.epw'\nutc_offset_hours = 2\nday = '2024-06-21'\n";
    EXPECT_TRUE(mentions(faults_of(text.text(), {{"w.epw", epw_text()}}), "1 hours ahead of UTC"));
    text.rest = "[time]\nweather = 'w.epw'\nday = '2024-06-21'\n";
    EXPECT_TRUE(mentions(faults_of(text.text(), {{"w.epw", epw_text(13)}}), "below the horizon"));
}

/// Overcast hours differ by a factor only.
TEST(RunFileWeather, OvercastHoursShareATrace) {
    std::string text = "time,direct_horizontal,diffuse\n";
    for (int hour = 8; hour < 16; ++hour) {
        text += fmt::format("2024-06-21T{:02d}:00+01:00,0,{}\n", hour, 10 * hour);
    }
    const TimeSeries series = series_of("weather = 'w.csv'\n", {{"w.csv", text}});
    const auto plans = plan_series(series.time_steps);
    for (const TimeStepPlan& plan : plans) {
        EXPECT_EQ(plan.traced, 0U);
    }
    EXPECT_NEAR(plans[7].factor, 15 / 8.0, 1e-9);
}

TEST(RunFileTime, EffortOfADayNeedsTimesWithLengths) {
    RunText text;
    text.run = "[run]\npath_allocation = 'proportional'\n";
    EXPECT_TRUE(mentions(
        faults_of(text.text()), "path_allocation: it is \"proportional\" (the run has no [time])"));
    text.top += "[site]\nlatitude_deg = 52\nlongitude_deg = 5\n";
    text.sources = "";
    text.rest = "[time]\ntimes = ['2024-06-21T12:00+02:00']\n";
    EXPECT_TRUE(mentions(
        faults_of(text.text()), "path_allocation: it is \"proportional\" (instants do not count"));
    text.rest += "duration_minutes = 60\n";
    EXPECT_TRUE(faults_of(text.text()).empty());
}

TEST(RunFileTime, HoursTogetherAreOfASeriesByRayBundles) {
    RunText text;
    text.run = "[run]\ntime_method = 'daylight_coefficients'\n";
    EXPECT_TRUE(mentions(
        faults_of(text.text()),
        "time_method: it is \"daylight_coefficients\" (the run has no [time])"));
    text.top += "[site]\nlatitude_deg = 52\nlongitude_deg = 5\n";
    text.sources = "";
    text.rest = "[time]\ntimes = ['2024-06-21T12:00+02:00']\nduration_minutes = 60\n";
    EXPECT_TRUE(mentions(faults_of(text.text()), "method is not ray_bundles"));
    text.run += "method = 'ray_bundles'\n";
    EXPECT_TRUE(faults_of(text.text()).empty());
}

}  // namespace
}  // namespace quasimc::test

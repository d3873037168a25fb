// Weather and clocks that are not what they seem.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "light/daylight/hour_light.h"
#include "quasimc/series.h"
#include "unit/runfile/time_testing.h"

namespace quasimc::test {
namespace {

RunFile run_of_weather(
    const std::string& keys, const FakeFiles& files, const std::string& site = "") {
    return read_text(with_time(keys, site), files);
}

/// An EPW file of hours of a band, one light in each, with dates of its own.
std::string epw_of(const std::vector<std::string>& hours, double zone = 1) {
    std::string text = fmt::format(
        "LOCATION,X,-,NLD,S,1,51.97,5.67,{},7\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n", zone);
    for (const std::string& hour : hours) {
        text += hour + ",60,?,0,0,0,0,0,0,0,0,500,100\n";
    }
    return text;
}

TEST(RunFileWeather, RefusesAnEpwRecordThatIsThereTwice) {
    const std::vector<std::string> twice{"2023,6,21,12", "2023,6,21,12", "2023,6,21,13"};
    const std::string keys = "weather = 'w.epw'\nday = '2023-06-21'\nhours = [11, 13]\n";
    const auto faults = faults_of(with_time(keys, ""), {{"w.epw", epw_of(twice)}});
    ASSERT_EQ(faults.size(), 1U) << ::testing::PrintToString(faults);
    EXPECT_TRUE(mentions(
        faults, "w.epw:4: the record of 2023-06-21T11:00+01:00 is repeated or out of order"));
}

/// Months of a typical year are of years in any order: here the file ends before it begins.
TEST(RunFileWeather, ReadsATypicalYearWhoseFirstMonthIsOfALaterYear) {
    std::vector<std::string> hours;
    for (const char* day :
         {"2001,1,1", "2001,1,2", "2001,1,3", "2000,9,28", "2000,9,29", "2000,9,30"}) {
        for (int hour = 1; hour <= 24; ++hour) {
            hours.push_back(fmt::format("{},{}", day, hour));
        }
    }
    const auto faults = faults_of(with_time("weather = 'w.epw'\n", ""), {{"w.epw", epw_of(hours)}});
    ASSERT_EQ(faults.size(), 1U) << ::testing::PrintToString(faults);
    EXPECT_TRUE(mentions(faults, "the time zone, the site or stamp is wrong"));
}

/// A 29 February of a typical year is left out where the year asked for has none.
TEST(RunFileWeather, LeavesOutADayThatTheYearDoesNotHave) {
    std::vector<std::string> hours;
    const std::vector<std::string> days{
        "1999,2,27", "1999,2,28", "2000,2,29", "1998,3,1", "1998,3,2"};
    for (const std::string& day : days) {
        for (int hour = 1; hour <= 24; ++hour) {
            hours.push_back(day + "," + std::to_string(hour));
        }
    }
    std::string dark = epw_of(hours);
    for (std::size_t at = dark.find("500,100"); at != std::string::npos;
         at = dark.find("500,100", at)) {
        dark.replace(at, 7, "0,10");
    }
    const auto read = [&](int year, const std::string& more) {
        return run_of_weather(
            fmt::format(
                "weather = 'w.epw'\nfrom = '{}-02-27'\nto = '{}-03-02'\n{}", year, year, more),
            {{"w.epw", dark}});
    };
    const RunFile plain = read(2023, "");
    EXPECT_EQ(
        plain.series->days,
        (std::vector<std::string>{"2023-02-27", "2023-02-28", "2023-03-01", "2023-03-02"}));
    EXPECT_EQ(plain.series->time_steps.size(), 96U);
    EXPECT_NE(all_warnings(plain).find("24 records of 29 February left out"), std::string::npos)
        << all_warnings(plain);
    EXPECT_EQ(read(2024, "").series->days.size(), 5U);
    EXPECT_EQ(all_warnings(read(2024, "")).find("29 February"), std::string::npos);
    EXPECT_EQ(read(2023, "cumulative_sky = 'day'\n").series->time_steps.size(), 4U);
    EXPECT_EQ(
        read(2023, "cumulative_sky = 'period'\n").series->time_steps.at(0).seconds,
        4 * kSecondsADay);
    const RunFile march = run_of_weather(
        "weather = 'w.epw'\nday = '2023-03-01'\nhours = [11, 12]\n", {{"w.epw", dark}});
    EXPECT_EQ(march.series->days, std::vector<std::string>{"2023-03-01"});
    EXPECT_EQ(march.series->time_steps.size(), 1U);
}

TEST(RunFileWeather, OfAnEpwFileHasNoUnit) {
    const std::string keys = "weather = 'w.epw'\nday = '2023-06-21'\nhours = [11, 12]\n";
    const FakeFiles files{{"w.epw", epw_of({"2023,6,21,12"})}};
    EXPECT_TRUE(mentions(
        faults_of(with_time(keys + "unit = 'PPFD'\n", ""), files),
        "unit is given for an EPW file (its irradiance is always in W m-2)"));
    EXPECT_TRUE(faults_of(with_time(keys + "unit = 'full_spectrum'\n", ""), files).empty());
    EXPECT_TRUE(faults_of(with_time(keys, ""), files).empty());
}

TEST(RunFileWeather, CountsRecordsByTheirPartWithinTheHours) {
    const FakeFiles files{{"w.epw", epw_of({"2023,6,21,7", "2023,6,21,8", "2023,6,21,9"})}};
    const RunFile run =
        run_of_weather("weather = 'w.epw'\nday = '2023-06-21'\nhours = [6.5, 8.25]\n", files);
    const auto& steps = run.series->time_steps;
    ASSERT_EQ(steps.size(), 3U);
    EXPECT_EQ(steps[0].name, "2023-06-21T06:30+01:00");
    EXPECT_EQ(steps[0].seconds, 1800);
    EXPECT_EQ(steps[1].seconds, 3600);
    EXPECT_EQ(steps[2].seconds, 900);
    EXPECT_NE(all_warnings(run).find("2 records beyond these hours"), std::string::npos);
    const RunFile whole =
        run_of_weather("weather = 'w.epw'\nday = '2023-06-21'\nhours = [6, 9]\n", files);
    EXPECT_EQ(all_warnings(whole).find("beyond these hours"), std::string::npos);
}

TEST(RunFileWeather, TakesYearsOfTwoDigitsAndSaysSo) {
    const RunFile run = run_of_weather("weather = 'w.epw'\n", {{"w.epw", epw_of({"83,6,21,12"})}});
    EXPECT_EQ(run.series->days, std::vector<std::string>{"1983-06-21"});
    EXPECT_NE(
        all_warnings(run).find("w.epw:3: 1 times have years of two digits, read as 1969 to 2068"),
        std::string::npos)
        << all_warnings(run);
}

/// Three days at 38 N, 1.1 W, hour by hour: clear, but for what `clouds` lets through of each hour.
template <typename Clouds>
std::vector<Reading> days_in_spain(double rows_ahead_hours, const Clouds& clouds) {
    std::vector<Reading> readings;
    constexpr double kLatitude = 38 * std::numbers::pi / 180;
    constexpr double kDeclination = 23.4 * std::numbers::pi / 180;
    for (int hour = 1; hour <= 72; ++hour) {
        const double solar = (hour - 1) % 24 + .5 - rows_ahead_hours - 1.1 / 15;
        const double sine = std::sin(kLatitude) * std::sin(kDeclination) +
                            std::cos(kLatitude) * std::cos(kDeclination) *
                                std::cos((solar - 12) / 12 * std::numbers::pi);
        Reading reading{.global = 0, .beam_normal = 0, .diffuse = 0};
        if (sine > 0) {
            const double part = clouds(hour);
            reading.beam_normal = part * 950 * std::exp(-.1 / sine);
            reading.diffuse = (.2 + .8 * part) * 110 * std::sqrt(sine);
            reading.global = *reading.beam_normal * sine + *reading.diffuse;
        }
        readings.push_back(reading);
    }
    return readings;
}

std::string clock_warnings(const std::vector<Reading>& readings, double zone, bool is_epw) {
    std::string text =
        is_epw ? fmt::format(
                     "LOCATION,X,-,ESP,S,1,38,-1.1,{},7\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n",
                     zone)
               : "time,global,diffuse\n";
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const Reading& reading = readings[i];
        const std::size_t day = 20 + i / 24;
        const std::size_t hour = i % 24 + 1;
        text += is_epw ? fmt::format(
                             "2023,6,{},{},60,?,0,0,0,0,0,0,0,0,{},{}\n", day, hour,
                             *reading.beam_normal, *reading.diffuse)
                       : fmt::format(
                             "2023-06-{}T{:02d}:00,{},{}\n", day, hour, *reading.global,
                             *reading.diffuse);
    }
    const std::string name = is_epw ? "w.epw" : "w.csv";
    RunFile run = run_of_weather(
        fmt::format(
            "weather = '{}'\n{}", name, is_epw ? "" : fmt::format("utc_offset_hours = {}\n", zone)),
        {{name, text}}, is_epw ? "" : "[site]\nlatitude_deg = 38\nlongitude_deg = -1.1\n");
    const std::string all = all_warnings(run);
    const std::size_t begin = all.find("daylight is about");
    return begin == std::string::npos ? "" : all.substr(begin, all.find('\n', begin) - begin);
}

TEST(RunFileWeather, WarnsOfAClockThatIsAnHourOrTwoWrong) {
    const auto clear = days_in_spain(1, [](int) { return 1.; });
    for (const bool is_epw : {true, false}) {
        EXPECT_EQ(clock_warnings(clear, 1, is_epw), "");
        // Global light further off is light at night, which is refused.
        for (const double wrong : is_epw ? std::vector{0., -1., 2., 3.} : std::vector{0., 2.}) {
            const std::string warning = clock_warnings(clear, wrong, is_epw);
            EXPECT_NE(warning.find(wrong < 1 ? "hours after" : "hours before"), std::string::npos)
                << wrong << " " << warning;
            EXPECT_NE(warning.find("is the time zone, the longitude"), std::string::npos)
                << warning;
        }
    }
}

TEST(RunFileWeather, SuspectsNoClockOfCloudyMornings) {
    const std::vector<std::function<double(int)>> skies{
        [](int hour) { return hour % 24 < 13 ? .0 : 1.; },
        [](int hour) { return hour % 24 < 13 ? 1. : .0; },
        [](int hour) { return hour < 24 && hour < 16 ? 0. : 1.; }, [](int) { return 0.; }};
    for (const auto& sky : skies) {
        EXPECT_EQ(clock_warnings(days_in_spain(1, sky), 1, true), "");
        EXPECT_EQ(clock_warnings(days_in_spain(1, sky), 1, false), "");
    }
}

TEST(RunFileTime, AsksWhetherLatitudeAndLongitudeAreExchanged) {
    const auto warns = [](const std::string& site, const std::string& clock) {
        return all_warnings(
                   read_text(with_time(
                       "day = '2024-06-21'\nhours = [11, 12]\nutc_offset_hours = " + clock + "\n",
                       "[site]\n" + site)))
                   .find("are latitude and longitude swapped?") != std::string::npos;
    };
    EXPECT_TRUE(warns("latitude_deg = 5.67\nlongitude_deg = 52\n", "1"));
    EXPECT_FALSE(warns("latitude_deg = 52\nlongitude_deg = 5.67\n", "1"));
    EXPECT_FALSE(warns("latitude_deg = 43\nlongitude_deg = -9.2\n", "2")) << "Galicia in summer";
    EXPECT_FALSE(warns("latitude_deg = 39.5\nlongitude_deg = 76\n", "8")) << "the west of China";
    EXPECT_FALSE(warns("latitude_deg = 1\nlongitude_deg = 37\n", "0")) << "UTC";
}

/// A day of a table in W m-2, divided by a factor.
std::string low_light_warnings(double divisor, const std::string& more = "") {
    std::string table = "time,global\n";
    for (int hour = 1; hour <= 24; ++hour) {
        const double light =
            std::max(0.0, 900 * std::cos((hour - 13.1) / 24 * 2 * std::numbers::pi) - 250);
        table += fmt::format("2024-06-21T{:02d}:00+01:00,{:.6f}\n", hour, light / divisor);
    }
    const std::string all =
        all_warnings(run_of_weather("weather = 'w.csv'\n" + more, {{"w.csv", table}}, kSite));
    const std::size_t begin = all.find("daytime values are at most");
    return begin == std::string::npos ? "" : all.substr(begin);
}

TEST(RunFileWeather, WarnsOfLessLightThanUnderTheDarkestClouds) {
    EXPECT_EQ(low_light_warnings(1), "");
    EXPECT_EQ(low_light_warnings(10), "") << "a dark day";
    EXPECT_NE(low_light_warnings(277.8).find("is it in MJ m-2 or kWh m-2"), std::string::npos);
    EXPECT_NE(
        low_light_warnings(1000).find("multiply by 277.8 or 1000 for 1 hours"), std::string::npos);
    EXPECT_NE(low_light_warnings(1, "unit = 'lux'\n").find("is the unit right"), std::string::npos);
}

TEST(RunFileWeather, TakesADateForItsDayAndAsksForMegajoulesOfDays) {
    const auto read = [](double light) {
        return run_of_weather(
            "weather = 'w.csv'\nutc_offset_hours = 1\nday = '2024-06-13'\n",
            {{"w.csv", fmt::format(
                           "time,global\n2024-06-12,{}\n2024-06-13,{}\n2024-06-14,{}\n", light,
                           1.1 * light, light)}},
            kSite);
    };
    const RunFile watts = read(200);
    ASSERT_EQ(watts.series->time_steps.size(), 1U);
    EXPECT_EQ(watts.series->days[0], "2024-06-13");
    EXPECT_NEAR(watts.series->notes[0].daylight.global(), 220, 1e-6);
    EXPECT_EQ(all_warnings(watts).find("daytime values"), std::string::npos) << all_warnings(watts);
    EXPECT_NE(
        all_warnings(read(20)).find("multiply by 11.57 or 41.67 for 24 hours"), std::string::npos)
        << all_warnings(read(20));
}

TEST(RunFileTime, WarnsOfNoLightWithTheSunHigh) {
    const auto warnings = [](const std::string& lights) {
        return all_warnings(read_text(with_time(
            "times = ['2024-06-21T03:00+01:00', '2024-06-21T12:00+01:00', "
            "'2024-06-21T13:00+01:00']\nduration_minutes = 60\nglobal = " +
            lights + "\n")));
    };
    EXPECT_NE(
        warnings("[0, 0, 700]").find("1 time has no light with the sun more than 10"),
        std::string::npos);
    EXPECT_EQ(warnings("[0, 20, 700]").find("no light with the sun"), std::string::npos);
}

TEST(RunFileTime, SaysFirstThatThereIsTooMuchLight) {
    const RunFile run = read_text(with_time(
        "times = ['2024-06-21T12:00+01:00']\nduration_minutes = 60\ndirect_horizontal = 5000\n"
        "diffuse = 10\n"));
    const std::string all = all_warnings(run);
    EXPECT_LT(
        all.find("more light than the sun gives outside the atmosphere"),
        all.find("more direct light than the sun"))
        << all;
}

}  // namespace
}  // namespace quasimc::test

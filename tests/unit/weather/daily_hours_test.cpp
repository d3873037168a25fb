#include "weather/daily_hours.h"

#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

CivilTime at(int hour, int minute = 0) {
    return {2024, 6, 21, hour, minute, 0, 1};
}

TEST(DailyHours, CoverPartsOfTimes) {
    const DailyHours day{{{6.5, 10}, {16, 22}}};
    EXPECT_EQ(day.share(at(5), 3600), 0);
    EXPECT_EQ(day.share(at(6), 3600), .5);
    EXPECT_EQ(day.share(at(7), 3600), 1);
    EXPECT_EQ(day.share(at(9, 45), 1800), .5);
    EXPECT_NEAR(day.share(at(0), 86400), 9.5 / 24, 1e-12);
    EXPECT_NEAR(day.share(at(20), 86400), 9.5 / 24, 1e-12) << "from evening to evening";
    EXPECT_EQ(day.describe(), "from 6.5 to 10 h, from 16 to 22 h");
}

TEST(DailyHours, HoldInstantsFromTheirBeginning) {
    const DailyHours day{{{6, 10}}};
    EXPECT_EQ(day.share(at(5, 59), 0), 0);
    EXPECT_EQ(day.share(at(6), 0), 1);
    EXPECT_EQ(day.share(at(10), 0), 0);
}

TEST(DailyHours, MayGoOverMidnight) {
    const DailyHours night{{{20, 4}}};
    EXPECT_EQ(night.share(at(23), 2 * 3600), 1);
    EXPECT_EQ(night.share(at(3), 2 * 3600), .5);
    EXPECT_EQ(night.share(at(12), 3600), 0);
    EXPECT_EQ(night.share(at(1), 0), 1);
    EXPECT_NEAR(night.share(at(0), 86400), 8.0 / 24, 1e-12);
    EXPECT_EQ((DailyHours{{{0, 24}}}.share(at(13), 86400)), 1);
}

TEST(DailyHours, ToldApartFromThoseThatOverlap) {
    EXPECT_TRUE((DailyHours{{{0, 6}, {5, 7}}}.overlap()));
    EXPECT_TRUE((DailyHours{{{20, 4}, {3, 5}}}.overlap()));
    EXPECT_TRUE((DailyHours{{{22, 24}, {20, 1}}}.overlap()));
    EXPECT_FALSE((DailyHours{{{0, 6}, {6, 7}, {20, 24}}}.overlap()));
    EXPECT_FALSE((DailyHours{{{20, 4}, {4, 20}}}.overlap()));
}

/// A lamp of 9 W with these hours, and [time].
std::string lamp_text(const std::string& hours, const std::string& time) {
    RunText text;
    text.sources = "[[source]]\ntype = 'point'\nposition = [0, 0, 3]\npower = 9\n" + hours;
    text.rest = time;
    return text.text();
}
constexpr const char* kNight =
    "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n[time]\nday = '2024-12-21'\n"
    "utc_offset_hours = 1\nhours = [0, 6]\n";

TEST(RunFileOnHours, SwitchLamps) {
    const RunFile run = read_text(lamp_text("on_hours = [[0, 2], [3.5, 5]]\n", kNight));
    ASSERT_EQ(run.series->time_steps.size(), 6U);
    std::vector<double> power;
    for (const TimeStep& time_step : run.series->time_steps) {
        ASSERT_EQ(time_step.sources.size(), 1U);
        EXPECT_TRUE(time_step.sources[0]->is_lamp());
        power.push_back(time_step.sources[0]->spectrum()[0]);
    }
    EXPECT_EQ(power, (std::vector<double>{9, 9, 0, 4.5, 9, 0}));
    const auto plans = plan_series(run.series->time_steps);
    EXPECT_EQ(plans[2].factor, 0) << "dark";
    EXPECT_EQ(plans[3].traced, 0U);
    EXPECT_NEAR(plans[3].factor, .5, 1e-12);
    const RunFile sum = read_text(lamp_text(
        "on_hours = [[0, 2], [3.5, 5]]\n", std::string(kNight) + "cumulative_sky = 'day'\n"));
    ASSERT_EQ(sum.series->time_steps.size(), 1U);
    EXPECT_NEAR(sum.series->time_steps[0].sources[0]->spectrum()[0], 9 * 3.5 / 6, 1e-9);
    EXPECT_NE(run.source_notes[0].find("; on from 0 to 2 h, from 3.5 to 5 h"), std::string::npos);
}

TEST(RunFileOnHours, NeedAClockAndAnEnd) {
    EXPECT_TRUE(
        mentions(faults_of(lamp_text("on_hours = [6, 22]\n", "")), "on_hours needs [time]"));
    const auto faults = [](const std::string& hours) {
        return faults_of(lamp_text(hours, kNight));
    };
    EXPECT_TRUE(mentions(faults("on_hours = 6\n"), "not a pair"));
    EXPECT_TRUE(mentions(faults("on_hours = []\n"), "not a pair"));
    EXPECT_TRUE(mentions(faults("on_hours = [[1, 2], 3]\n"), "not a pair"));
    EXPECT_TRUE(mentions(faults("on_hours = [5, 5]\n"), "ends where it begins"));
    EXPECT_TRUE(mentions(faults("on_hours = [5, 25]\n"), "on_hours"));
    EXPECT_TRUE(mentions(faults("on_hours = [[0, 6], [5, 7]]\n"), "overlap"));
}

}  // namespace
}  // namespace quasimc::test

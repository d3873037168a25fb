// Times of [time] that are collapsed into one moment.

#include <string>

#include <gtest/gtest.h>

#include "io/results/write_series.h"
#include "run/series.h"
#include "unit/io/io_testing.h"

namespace quasimc::test {
namespace {

/// A run file with [time] and two bands.
std::string with_two_bands(const std::string& keys) {
    RunText text;
    text.top = "[[band]]\nname = 'PAR'\nunit = 'umol m-2 s-1'\n[[band]]\nname = 'NIR'\n";
    text.sources = "";
    text.rest = "[place]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n[time]\n" + keys;
    return text.text();
}

constexpr const char* kDays = "from = '2024-06-20'\nto = '2024-06-22'\nutc_offset_hours = 1\n";

/// Light on the horizontal times seconds, summed over moments.
double sum_over(const TimeSeries& series, std::size_t band) {
    double sum = 0;
    for (const TimeStep& time_step : series.time_steps) {
        for (const auto& source : time_step.sources) {
            sum += time_step.seconds * source->spectrum()[band] * source->horizontal_irradiance();
        }
    }
    return sum;
}

TEST(RunFileCollapse, MakesAMomentOfAPeriod) {
    const TimeSeries hours = *read_text(with_two_bands(kDays)).series;
    const TimeSeries one =
        *read_text(with_two_bands(std::string(kDays) + "collapse = 'period'\n")).series;
    ASSERT_EQ(one.time_steps.size(), 1U);
    EXPECT_EQ(one.time_steps[0].seconds, 3 * 86400);
    EXPECT_EQ(one.days, std::vector<std::string>{"2024-06-20/2024-06-22"});
    for (const std::size_t band : {0U, 1U}) {
        EXPECT_NEAR(sum_over(one, band), sum_over(hours, band), 1e-6 * sum_over(hours, band));
    }
    const MomentNotes& notes = one.notes[0];
    ASSERT_TRUE(notes.collapsed.has_value());
    std::size_t suns = 0;
    std::size_t lit = 0;
    for (const MomentNotes& hour : hours.notes) {
        suns += hour.suns;
        lit += hour.daylight.global() > 0 ? 1 : 0;
        EXPECT_FALSE(hour.collapsed.has_value());
    }
    EXPECT_EQ(notes.suns, suns);
    EXPECT_EQ(notes.collapsed->times, 72U);
    EXPECT_EQ(notes.collapsed->with_light, lit);
    EXPECT_EQ(notes.collapsed->skies, 2U) << "blue and white";
    EXPECT_EQ(one.time_steps[0].sources.size(), suns + 2);
    EXPECT_EQ(notes.time, "2024-06-20T00:00+01:00");
    EXPECT_EQ(notes.collapsed->until, "2024-06-23T00:00+01:00");
}

TEST(RunFileCollapse, MakesAMomentOfEachDay) {
    const TimeSeries hours = *read_text(with_two_bands(kDays)).series;
    const TimeSeries days =
        *read_text(with_two_bands(std::string(kDays) + "collapse = 'days'\n")).series;
    ASSERT_EQ(days.time_steps.size(), 3U);
    EXPECT_EQ(days.days, hours.days);
    EXPECT_EQ(days.time_steps[2].day, 2U);
    EXPECT_EQ(days.time_steps[1].seconds, 86400);
    EXPECT_NEAR(sum_over(days, 0), sum_over(hours, 0), 1e-6 * sum_over(hours, 0));
    EXPECT_EQ(plan_series(days.time_steps)[1].traced, 1U) << "no two days are alike";
}

TEST(RunFileCollapse, LetsLampsShineOn) {
    RunText text;
    text.sources = "[[source]]\ntype = 'point'\nposition = [0, 0, 3]\npower = 9\n";
    text.rest =
        "[place]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n[time]\nday = '2024-06-21'\n"
        "utc_offset_hours = 1\ncollapse = 'days'\nhours = [0, 3]\n";
    const RunFile run = read_text(text.text());
    ASSERT_EQ(run.series->time_steps.size(), 1U);
    ASSERT_EQ(run.series->time_steps[0].sources.size(), 1U) << "it is night";
    EXPECT_TRUE(run.series->time_steps[0].sources[0]->is_lamp());
    EXPECT_EQ(run.series->time_steps[0].seconds, 3 * 3600);
}

TEST(RunFileCollapse, NeedsTimesWithALength) {
    const std::string times = "times = ['2024-06-21T13:40+02:00']\ncollapse = 'period'\n";
    EXPECT_TRUE(mentions(faults_of(with_two_bands(times)), "instants are to be collapsed"));
    EXPECT_EQ(
        read_text(with_two_bands(times + "duration_minutes = 10\n")).series->time_steps.size(), 1U);
    EXPECT_TRUE(mentions(
        faults_of(with_two_bands(std::string(kDays) + "collapse = 'weeks'\n")),
        "collapse is 'weeks'"));
}

std::string series_json(const RunFile& run) {
    std::string text;
    SeriesJson json(run, [&](std::string_view part) { text += part; });
    json.add_moment(0, dark_result(run.scene, run.spec), 0);
    static_cast<void>(json.finish({}));
    return text;
}

TEST(RunFileCollapse, IsToldInTheResults) {
    const RunFile run = read_text(with_two_bands(std::string(kDays) + "collapse = 'period'\n"));
    std::string csv;
    write_days_head(run, [&](std::string_view part) { csv += part; });
    EXPECT_NE(
        csv.find("# moment: 2024-06-20T00:00+01:00 to 2024-06-23T00:00+01:00, 259200 s: 72 "),
        std::string::npos);
    EXPECT_NE(csv.find("incident_upper_PAR [mol m-2]:"), std::string::npos);
    const std::string json = series_json(run);
    EXPECT_NE(
        json.find("\"until\": \"2024-06-23T00:00+01:00\", \"collapsed\": {\"times\": 72"),
        std::string::npos);
    EXPECT_EQ(json.find("azimuth_deg\": "), std::string::npos);
    const RunFile days = read_text(with_two_bands(std::string(kDays) + "collapse = 'days'\n"));
    csv.clear();
    write_days_head(days, [&](std::string_view part) { csv += part; });
    EXPECT_NE(csv.find("incident_upper_PAR [mol m-2 d-1]:"), std::string::npos);
}

}  // namespace
}  // namespace quasimc::test

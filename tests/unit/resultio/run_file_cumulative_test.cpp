// Cumulative skies of [time].

#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "quasimc/result_file.h"
#include "quasimc/run_file.h"
#include "quasimc/series.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// A run file with [time] and two bands.
std::string with_two_bands(const std::string& keys) {
    RunText text;
    text.top = "[[band]]\nname = 'PAR'\nunit = 'umol m-2 s-1'\n[[band]]\nname = 'NIR'\n";
    text.sources = "";
    text.rest = "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n[time]\n" + keys;
    return text.text();
}

constexpr const char* kDays = "from = '2024-06-20'\nto = '2024-06-22'\nutc_offset_hours = 1\n";

/// Light on the horizontal times seconds, summed over time steps.
double sum_over(const TimeSeries& series, std::size_t band) {
    double sum = 0;
    for (const TimeStep& time_step : series.time_steps) {
        for (const auto& source : time_step.sources) {
            sum += time_step.seconds * source->spectrum()[band] * source->horizontal_irradiance();
        }
    }
    return sum;
}

TEST(RunFileCumulative, MakesATimeStepOfAPeriod) {
    const TimeSeries hours = *read_text(with_two_bands(kDays)).series;
    const TimeSeries one =
        *read_text(with_two_bands(std::string(kDays) + "cumulative_sky = 'period'\n")).series;
    ASSERT_EQ(one.time_steps.size(), 1U);
    EXPECT_EQ(one.time_steps[0].seconds, 3 * 86400);
    EXPECT_EQ(one.days, std::vector<std::string>{"2024-06-20/2024-06-22"});
    for (const std::size_t band : {0U, 1U}) {
        EXPECT_NEAR(sum_over(one, band), sum_over(hours, band), 1e-6 * sum_over(hours, band));
    }
    const TimeStepNotes& notes = one.notes[0];
    ASSERT_TRUE(notes.cumulated.has_value());
    std::size_t suns = 0;
    std::size_t lit = 0;
    for (const TimeStepNotes& hour : hours.notes) {
        suns += hour.suns;
        lit += hour.daylight.global() > 0 ? 1 : 0;
        EXPECT_FALSE(hour.cumulated.has_value());
    }
    EXPECT_EQ(notes.suns, suns);
    EXPECT_EQ(notes.cumulated->times, 72U);
    EXPECT_EQ(notes.cumulated->with_light, lit);
    EXPECT_EQ(notes.cumulated->skies, 2U) << "blue and white";
    EXPECT_EQ(one.time_steps[0].sources.size(), suns + 2);
    EXPECT_EQ(notes.time, "2024-06-20T00:00+01:00");
    EXPECT_EQ(notes.cumulated->until, "2024-06-23T00:00+01:00");
}

TEST(RunFileCumulative, MakesATimeStepOfEachDay) {
    const TimeSeries hours = *read_text(with_two_bands(kDays)).series;
    const TimeSeries days =
        *read_text(with_two_bands(std::string(kDays) + "cumulative_sky = 'day'\n")).series;
    ASSERT_EQ(days.time_steps.size(), 3U);
    EXPECT_EQ(days.days, hours.days);
    EXPECT_EQ(days.time_steps[2].day, 2U);
    EXPECT_EQ(days.time_steps[1].seconds, 86400);
    EXPECT_NEAR(sum_over(days, 0), sum_over(hours, 0), 1e-6 * sum_over(hours, 0));
    EXPECT_EQ(plan_series(days.time_steps)[1].traced, 1U) << "no two days are alike";
}

TEST(RunFileCumulative, LetsLampsShineOn) {
    RunText text;
    text.sources = "[[source]]\ntype = 'point'\nposition = [0, 0, 3]\npower = 9\n";
    text.rest =
        "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n[time]\nday = '2024-06-21'\n"
        "utc_offset_hours = 1\ncumulative_sky = 'day'\nhours = [0, 3]\n";
    const RunFile run = read_text(text.text());
    ASSERT_EQ(run.series->time_steps.size(), 1U);
    ASSERT_EQ(run.series->time_steps[0].sources.size(), 1U) << "it is night";
    EXPECT_TRUE(run.series->time_steps[0].sources[0]->is_lamp());
    EXPECT_EQ(run.series->time_steps[0].seconds, 3 * 3600);
}

TEST(RunFileCumulative, NeedsTimesWithALength) {
    const std::string times = "times = ['2024-06-21T13:40+02:00']\ncumulative_sky = 'period'\n";
    EXPECT_TRUE(mentions(faults_of(with_two_bands(times)), "instants have no cumulative sky"));
    EXPECT_EQ(
        read_text(with_two_bands(times + "duration_minutes = 10\n")).series->time_steps.size(), 1U);
    EXPECT_TRUE(mentions(
        faults_of(with_two_bands(std::string(kDays) + "cumulative_sky = 'weeks'\n")),
        "cumulative_sky: 'weeks' is not one of none, day, period"));
}

std::string days_head(const RunFile& run) {
    std::string text;
    const CsvWriter days(
        run, [&](std::string_view part) { text += part; }, CsvRows::organs, CsvTimes::days);
    return text;
}

std::string series_json(RunFile run) {
    run.output.include_night = true;  // the result is dark
    std::string text;
    JsonWriter json(run, [&](std::string_view part) { text += part; });
    json.on_time_step({0, zero_result(run.scene, run.spec)});
    json.finish({});
    return text;
}

TEST(RunFileCumulative, IsToldInTheResults) {
    const RunFile run =
        read_text(with_two_bands(std::string(kDays) + "cumulative_sky = 'period'\n"));
    const std::string csv = days_head(run);
    EXPECT_NE(
        csv.find("# time_step: 2024-06-20T00:00+01:00 to 2024-06-23T00:00+01:00, 259200 s: 72 "),
        std::string::npos);
    EXPECT_NE(csv.find("incident_upper_PAR [mol m-2]:"), std::string::npos);
    const std::string json = series_json(run);
    EXPECT_NE(
        json.find("\"until\": \"2024-06-23T00:00+01:00\",\n\"cumulative_sky\": {\n  \"times\": 72"),
        std::string::npos);
    EXPECT_EQ(json.find("azimuth_deg\": "), std::string::npos);
    const RunFile days = read_text(with_two_bands(std::string(kDays) + "cumulative_sky = 'day'\n"));
    EXPECT_NE(days_head(days).find("incident_upper_PAR [mol m-2 d-1]:"), std::string::npos);
}

/// A sum in which every value is `mean`.
SeriesSum flat_sum(const RunFile& run, double seconds, double mean) {
    SeriesSum sum;
    sum.bands = run.scene.bands().size();
    sum.seconds = seconds;
    sum.values.resize(run.scene.organs().size() * kQuantities * sum.bands, {mean, 0, mean, mean});
    return sum;
}

TEST(JsonOfTimes, HasTimeStepsThenDaysThenTheTotal) {
    RunFile run = read_text(with_two_bands(kDays));
    run.output.include_night = true;  // all results are dark
    std::string text;
    std::string digest;
    {
        JsonWriter json(run, [&](std::string_view part) { text += part; });
        const Result dark = zero_result(run.scene, run.spec);
        for (std::size_t day = 0; day < 3; ++day) {
            for (std::size_t hour = 0; hour < 24; ++hour) {
                json.on_time_step({24 * day + hour, dark, 24 * day + hour});
            }
            json.on_day(day, flat_sum(run, 86400, 1 + static_cast<double>(day)));
        }
        SeriesSummary summary;
        summary.completed = 72;
        summary.total = flat_sum(run, 3 * 86400, 6);
        json.finish(summary);
        digest = json.digest();
    }
    const auto json = nlohmann::ordered_json::parse(text);
    EXPECT_EQ(json["time_steps"].size(), 72U);
    EXPECT_EQ(json["time_steps"][71]["time"], "2024-06-22T23:00+01:00");
    EXPECT_EQ(json["time_steps"][71]["organs"].size(), 1U);
    ASSERT_EQ(json["days"].size(), 3U);
    EXPECT_EQ(json["days"][2]["date"], "2024-06-22");
    EXPECT_EQ(json["days"][2]["seconds"], 86400);
    EXPECT_EQ(json["days"][2]["organs"][0]["incident_upper"]["NIR"]["mean"], 3);
    EXPECT_EQ(json["days"][2]["organs"][0]["incident_upper"]["PAR"]["mean"], 3e-6) << "mol";
    EXPECT_EQ(json["total"]["organs"][0]["incident_upper"]["NIR"]["ci95_high"], 6);
    EXPECT_EQ(json["completed"]["time_steps"], 72);
    EXPECT_EQ(json["organs_sha256"], digest);
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) {
        keys.push_back(key);
    }
    const auto where = [&](const char* key) { return std::find(keys.begin(), keys.end(), key); };
    EXPECT_LT(where("time_steps"), where("days"));
    EXPECT_LT(where("days"), where("total"));
    EXPECT_LT(where("total"), where("organs_sha256"));
}

TEST(JsonOfTimes, HasADigestWithoutAFile) {
    const RunFile run = read_text(with_two_bands(kDays));
    const Result dark = zero_result(run.scene, run.spec);
    std::string text;
    JsonWriter written(run, [&](std::string_view part) { text += part; });
    JsonWriter unwritten(run);
    for (JsonWriter* json : {&written, &unwritten}) {
        json->on_time_step({0, dark});
        json->on_day(0, flat_sum(run, 1, 1));
    }
    EXPECT_EQ(unwritten.digest(), written.digest());
    EXPECT_NE(written.digest(), JsonWriter(run).digest()) << "of nothing";
}

TEST(TimeStepsOf, ARunWithoutTimesAreOneInstant) {
    Simulator simulator;
    RunFile single = read_text(RunText{}.text());
    const std::vector<TimeStep> one = time_steps_of(single, simulator);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].sources, single.sources);
    EXPECT_EQ(one[0].seconds, 0);
    RunFile days = read_text(with_two_bands(kDays));
    EXPECT_EQ(time_steps_of(days, simulator).size(), 72U);
}

}  // namespace
}  // namespace quasimc::test

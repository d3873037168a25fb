// Lamps under control in summaries, tables and JSON.

#include "resultio/write_control.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "quasimc/error.h"
#include "quasimc/result_file.h"
#include "resultio/output_input.h"
#include "resultio/read_controls.h"
#include "resultio/read_rows.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// Two hours of a night, with a lamp that was on for 1.5 h of them.
RunFile night() {
    RunText text;
    text.top =
        "length_unit = 'm'\n[[band]]\nname = 'PPFD'\nunit = 'umol m-2 s-1'\nfrom_nm = 400\nto_nm = "
        "700\n";
    text.sources =
        "[[source]]\ntype = 'point'\nname = 'hps 1'\nposition = [5, 5, 2]\n"
        "photon_flux = 100\n";
    text.rest =
        "[[sensors]]\nname = 'bench'\nat = [[5, 5, 0]]\n[site]\nlatitude_deg = 52\n"
        "longitude_deg = 6\n[time]\nday = '2024-12-15'\nhours = [2, 4]\n"
        "utc_offset_hours = 1\n[[control]]\nsources = 'hps *'\nsensors = 'bench'\n"
        "on_below = 100\nelectrical_power_w = 1000\n";
    RunFile run = read_text(text.text());
    ControlOutcome outcome{.lamps = 1};
    outcome.steps = {
        {.factor = 1, .on = 1, .kwh = 1, .lamps = {200, 2, 196, 204}, .light = {200, 2, 196, 204}},
        {.factor = .5,
         .on = .5,
         .kwh = .5,
         .daylight = {99, 1, 97, 101},
         .lamps = {100, 1, 98, 102},
         .light = {199, 1.5, 196, 202},
         .is_near_threshold = true}};
    outcome.days = {
        {.hours_on = 1.5,
         .kwh = 1.5,
         .hours_near_threshold = 1,
         .lamps = {1e6, 1e4, 0, 2e6},
         .light = {12e6, 2e4, 0, 24e6}}};
    run.series->outcomes = {outcome};
    return run;
}

std::vector<std::string> rows_of(const RunFile& run, CsvTimes times) {
    std::string text;
    const TableSpec table{.file = "a.csv", .rows = CsvRows::control, .times = times};
    make_control_table({run, [&](std::string_view more) { text += more; }, {}, {}, &table})
        ->finish({});
    std::vector<std::string> rows{""};
    for (const char c : text) {
        c == '\n' ? rows.emplace_back() : rows.back() += c;
    }
    std::erase_if(rows, [](const auto& row) { return row.empty() || row.starts_with('#'); });
    return rows;
}

TEST(WriteControl, HasARowForEachTime) {
    const std::vector<std::string> rows = rows_of(night(), CsvTimes::time_steps);
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(
        rows[0],
        "time,control,factor,on,kwh,band,unit,daylight,daylight_se,lamps,lamps_se,light,light_se");
    EXPECT_EQ(
        rows[2], "2024-12-15T03:00+01:00,hps *,0.5,0.5,0.5,PPFD,umol m-2 s-1,99,1,100,1,199,1.5");
}

TEST(WriteControl, HasARowForEachDay) {
    const std::vector<std::string> rows = rows_of(night(), CsvTimes::days);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(
        rows[0],
        "date,control,hours_on,kwh,hours_near_threshold,band,unit,lamps,lamps_se,light,light_se");
    EXPECT_EQ(rows[1], "2024-12-15,hps *,1.5,1.5,1,PPFD,mol m-2,1,0.01,12,0.02");
}

TEST(WriteControl, IsALineOfTheSummary) {
    const RunFile run = night();
    Summary summary(run);
    const std::string text = summary.text({}, {});
    EXPECT_NE(
        text.find("control   hps: on 02:00-03:30, 1.5 h, 1.50 kWh, 12.0 mol m-2; daylight is "
                  "within 2 standard errors of on_below for 1 h\n"),
        std::string::npos)
        << text;
}

std::string json_of(const RunFile& run) {
    std::string text;
    JsonWriter writer(run, [&](std::string_view more) { text += more; });
    writer.finish({});
    return text;
}

std::vector<ControlOutcome> read_back(const std::string& json, const RunFile& run) {
    const Node rest = read_rows(json, "a.json", {.rest = RowsQuery::Rest::all}, {});
    return read_controls(rest, 0, run, "a.json");
}

TEST(WriteControl, IsReadBackFromTheJson) {
    const RunFile run = night();
    const std::vector<ControlOutcome> read = read_back(json_of(run), run);
    ASSERT_EQ(read.size(), 1U);
    EXPECT_EQ(read[0].lamps, 1U);
    ASSERT_EQ(read[0].steps.size(), 2U);
    const ControlStep &step = read[0].steps[1], &written = run.series->outcomes[0].steps[1];
    EXPECT_EQ(step.factor, written.factor);
    EXPECT_EQ(step.on, written.on);
    EXPECT_EQ(step.kwh, written.kwh);
    EXPECT_TRUE(step.is_near_threshold);
    EXPECT_FALSE(read[0].steps[0].is_near_threshold);
    EXPECT_EQ(step.daylight.mean, 99);
    EXPECT_EQ(step.lamps.ci95_low, 98);
    EXPECT_EQ(step.light.standard_error, 1.5);
    ASSERT_EQ(read[0].days.size(), 1U);
    EXPECT_EQ(read[0].days[0].hours_on, 1.5);
    EXPECT_EQ(read[0].days[0].hours_near_threshold, 1);
    EXPECT_EQ(read[0].days[0].lamps.mean, 1) << "mol m-2";
    EXPECT_EQ(read[0].days[0].light.ci95_high, 24);
}

TEST(WriteControl, IsNotReadFromTheResultOfAnotherRun) {
    const RunFile run = night();
    const auto refusal = [&](const std::string& from, const std::string& to) {
        std::string json = json_of(run);
        json.replace(json.find(from, json.rfind("\"control\"")), from.size(), to);
        try {
            static_cast<void>(read_back(json, run));
        } catch (const InputError& error) {
            return error.faults().at(0).text();
        }
        return std::string("none");
    };
    EXPECT_EQ(
        refusal("T03:00", "T04:00"),
        "a.json: 'control' has other time steps than the run (the file is damaged)");
    EXPECT_EQ(
        refusal("hps *", "hps"),
        "a.json: 'control' has other controls than the run (the file is damaged)");
    EXPECT_EQ(
        refusal("2024-12-15\"", "2024-12-16\""),
        "a.json: 'control' has other days than the run (the file is damaged)");
    EXPECT_EQ(refusal("0.5", "0.25"), "none");
}

TEST(WriteControl, IsAMemberOfTheJson) {
    const RunFile run = night();
    const nlohmann::json control = nlohmann::json::parse(json_of(run)).at("control").at(0);
    EXPECT_EQ(control.at("sources"), "hps *");
    EXPECT_EQ(control.at("lamps"), 1);
    EXPECT_EQ(control.at("sum_unit"), "mol m-2");
    EXPECT_EQ(control.at("time_steps").at(1).at("time"), "2024-12-15T03:00+01:00");
    EXPECT_EQ(control.at("time_steps").at(1).at("factor"), .5);
    EXPECT_EQ(control.at("time_steps").at(1).at("is_near_threshold"), true);
    EXPECT_EQ(control.at("days").at(0).at("light").at("mean"), 12);
    EXPECT_EQ(control.at("days").at(0).at("kwh"), 1.5);
}

}  // namespace
}  // namespace quasimc::test

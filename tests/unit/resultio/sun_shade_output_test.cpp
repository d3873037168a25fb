// The light of sunlit and shaded parts in run files and outputs.

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "quasimc/series.h"
#include "resultio/describe_series.h"
#include "resultio/output_input.h"
#include "support/listening.h"
#include "text/line_scanner.h"
#include "unit/resultio/replay_testing.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// A leaf that another one shades by half.
RunText half_shaded() {
    RunText text;
    text.run = "[run]\npaths = 256\nmethod = 'first_hits'\n";
    const auto leaf = [](const char* x, const char* height) {
        return "[[organ]]\nmaterial = 'leaf'\nshape = 'parallelogram'\ncorner = [" +
               std::string(x) + ", 0, " + height + "]\nedge_a = [1, 0, 0]\nedge_b = [0, 1, 0]\n";
    };
    text.organs = leaf("0", "1") + leaf("0.5", "2");
    return text;
}

RunText half_shaded_day() {
    RunText text = half_shaded();
    text.top += "[site]\nlatitude_deg = 40\nlongitude_deg = 0\n";
    text.sources = "";
    text.rest = "[time]\nday = '2024-06-21'\nhours = [11, 13]\nutc_offset_hours = 0\n";
    return text;
}

const std::string kParts =
    "[output]\nquantities = ['incident_upper_sunlit', 'sunlit_fraction_upper']\n";

/// The names of the columns, and the fields of the first row.
struct Csv {
    std::vector<std::string> names, first;

    [[nodiscard]] std::string at(const std::string& name) const {
        const auto found = std::ranges::find(names, name);
        return found == names.end() ? "none" : first.at(found - names.begin());
    }
};

std::vector<std::string> fields_of(std::string_view line) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
        c == ',' ? static_cast<void>(fields.emplace_back()) : fields.back().push_back(c);
    }
    return fields;
}

Csv parsed(const std::string& text) {
    Csv csv;
    LineScanner scanner(text);
    while (scanner.next() && csv.first.empty()) {
        if (!scanner.line().starts_with('#')) {
            (csv.names.empty() ? csv.names : csv.first) = fields_of(scanner.line());
        }
    }
    return csv;
}

TEST(SunShadeOutput, IsComputedIfAQuantityIsNamed) {
    EXPECT_EQ(read_text(half_shaded().text()).spec.sun_shade, SunShade::together);
    RunText named = half_shaded();
    named.rest = kParts;
    EXPECT_EQ(read_text(named.text()).spec.sun_shade, SunShade::apart);
    named.rest = "[[table]]\nfile = 't.csv'\nquantities = ['absorbed_flux_density_shaded']\n";
    EXPECT_EQ(read_text(named.text()).spec.sun_shade, SunShade::apart);
}

TEST(SunShadeOutput, HasItsColumnsInTables) {
    RunText text = half_shaded();
    text.rest = kParts;
    const RunFile run = read_text(text.text());
    const Result result = quasimc::run(run.scene, run.sources, run.spec);
    std::string out;
    CsvWriter(run, [&](std::string_view piece) { out += piece; }).on_time_step({0, result});
    const Csv csv = parsed(out);
    EXPECT_NEAR(std::stod(csv.at("incident_upper_sunlit_PAR")), 1, 1e-6);
    EXPECT_NEAR(std::stod(csv.at("sunlit_fraction_upper")), .5, .02);
    EXPECT_EQ(csv.at("absorbed_flux_PAR"), "none");
    EXPECT_EQ(csv.at("incident_lower_sunlit_PAR"), "none");
}

TEST(SunShadeOutput, IsInJsonByItsNames) {
    RunText text = half_shaded();
    text.run += "sun_shade = 'apart'\n";
    const RunFile run = read_text(text.text());
    const Result result = quasimc::run(run.scene, run.sources, run.spec);
    std::string written;
    write_json(run, result, [&](std::string_view piece) { written += piece; });
    const auto json = nlohmann::json::parse(written);
    EXPECT_EQ(json["quantities"].size(), kQuantities + kSunShadeQuantities);
    EXPECT_EQ(json["quantities"].back()["unit"]["PAR"], "W m-2");
    for (const auto& organ : {json["organs"][0], json["groups"][0]}) {
        EXPECT_NEAR(organ["absorbed_flux_density_sunlit"]["PAR"]["mean"], 1, 1e-6);
        EXPECT_EQ(organ["absorbed_flux_density_shaded"]["PAR"]["mean"], 0);
        EXPECT_TRUE(organ["incident_lower_sunlit"]["PAR"]["mean"].is_null());
    }
    EXPECT_NEAR(json["organs"][0]["sunlit_fraction_upper"]["mean"], .5, .02);
}

/// Days have hours in the sun, also if only a table of days names them.
TEST(SunShadeOutput, OfDaysHasSunlitHours) {
    RunText text = half_shaded_day();
    text.rest +=
        "[[table]]\nfile = 't.csv'\nrows = 'groups'\nper = 'day'\nquantities = ['sunlit_hours', "
        "'sunlit_area_hours', 'sunlit_hours_upper', 'incident_upper_sunlit']\n";
    const RunFile run = read_text(text.text());
    std::string table, groups;
    const TableSpec& spec = run.output.tables.at(0);
    const auto writer = make_table(
        {run, [&](std::string_view piece) { table += piece; }, spec.file, spec.location, &spec});
    CsvWriter days(
        run, [&](std::string_view piece) { groups += piece; }, CsvRows::groups, CsvTimes::days);
    run_series(run.scene, run.series->time_steps, run.spec, {.listeners = {writer.get(), &days}});
    const Csv csv = parsed(table), all = parsed(groups);
    const double hours = std::stod(csv.at("sunlit_hours"));
    EXPECT_NEAR(hours, 1.5, .2);  // one leaf is sunlit for two hours, the other one half
    EXPECT_NEAR(std::stod(csv.at("sunlit_area_hours")), 2 * hours, 1e-12);
    EXPECT_EQ(csv.at("sunlit_hours_upper"), csv.at("sunlit_hours"));
    for (const std::string name :
         {"sunlit_hours", "sunlit_area_hours", "incident_upper_sunlit_PAR"}) {
        EXPECT_EQ(all.at(name), csv.at(name)) << name;
    }
}

/// The estimates that JSON has, as they are reported.
void expect_read(const std::vector<Estimate>& read, const std::vector<Estimate>& written) {
    ASSERT_EQ(read.size(), written.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
        const double mean = reported(written[i]).mean;
        EXPECT_TRUE(read[i].mean == mean || (std::isnan(read[i].mean) && std::isnan(mean))) << i;
    }
}

TEST(SunShadeOutput, IsReadFromJson) {
    RunText text = half_shaded_day();
    text.run += "sun_shade = 'apart'\n";
    text.rest += "[[sensors]]\nat = [[0.25, 0.5, 1.5], [0.75, 0.5, 1.5]]\n";
    const RunFile run = read_text(text.text());
    std::string json;
    JsonWriter writer(run, [&](std::string_view piece) { json += piece; });
    std::vector<Result> results;
    std::vector<SeriesSum> days;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        results.push_back(result);
    };
    events.day = [&](std::size_t, const SeriesSum& sum) {
        days.push_back(in_summed_units(run, sum));
    };
    writer.finish(
        run_series(run.scene, run.series->time_steps, run.spec, {.listeners = {&writer, &events}}));
    LightEvents reader;
    reader.on_result = [&](std::size_t step, const Result& read) {
        expect_read(read.sun_shade.values, results.at(step).sun_shade.values);
    };
    std::size_t days_read = 0;
    reader.on_sum = [&](std::size_t day, const SeriesSum& read) {
        ++days_read;
        expect_read(read.sun_shade.values, days.at(day).sun_shade.values);
        expect_read(read.sunlit_hours, days.at(day).sunlit_hours);
        expect_read(read.sensors->sunlit_hours, days.at(day).sensors->sunlit_hours);
        EXPECT_NEAR(read.sensors->sunlit_hours.at(0).mean, 2, .02) << "beside the upper leaf";
    };
    replay(json, text.text(), reader);
    EXPECT_EQ(days_read, 1U);
    std::string again;
    std::optional<JsonWriter> second;
    replay_with(json, text.text(), [&](const RunFile& read) -> OutputWriter& {
        return second.emplace(read, [&](std::string_view piece) { again += piece; });
    });
    const auto light_of = [](const std::string& of) { return of.substr(of.find("\"warnings\"")); };
    EXPECT_EQ(light_of(again), light_of(json));
}

TEST(SunShadeOutput, IsRefusedWithoutInstants) {
    RunText text = half_shaded_day();
    const std::string time = text.rest;
    text.rest = time + "cumulative_sky = 'day'\n" + kParts;
    EXPECT_TRUE(mentions(
        faults_of(text.text()), "sun_shade: light of sunlit and shaded parts, with a cumulative"));
    text.rest = time + kParts;
    EXPECT_TRUE(faults_of(text.text()).empty());
    text.run = "[run]\nmethod = 'ray_bundles'\ntime_method = 'daylight_coefficients'\n";
    EXPECT_TRUE(mentions(faults_of(text.text()), "with light of sunlit and shaded parts"));
}

}  // namespace
}  // namespace quasimc::test

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "quasimc/result_file.h"
#include "quasimc/run_file.h"
#include "resultio/describe_result.h"
#include "results/units.h"
#include "text/line_scanner.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Two organs with names that need care, two bands, one ratio.
/// @param keys  of the second organ
RunFile small_run(const std::string& keys = "") {
    RunText text;
    text.top = "title = \"a,\\nb\"\nbands = ['R', 'FR']\nlength_unit = 'cm'\n";
    text.run = "[run]\nratios = ['R:FR']\n";
    text.organs =
        "[[organ]]\nname = 'a \"b\", #c'\nlabels = { plant = 1, area = 'x' }\nmaterial = "
        "'leaf'\nshape = 'triangle'\n"
        "corners = [[0, 0, 1], [2, 0, 1], [0, 2, 1]]\n"
        "[[organ]]\nname = 'd'\nlabels = { kind = 'leaf' }\nmaterial = 'leaf'\nshape = 'triangle'\n"
        "corners = [[0, 0, 2], [1, 0, 2], [0, 1, 2]]\n" +
        keys;
    return read_text(text.text());
}

/// Estimate i is i with error i / 10; organ 1 was never hit.
Result small_result() {
    Result result;
    result.bands = 2;
    result.ratios = 1;
    for (int i = 0; i < 24; ++i) {
        const double x = i;
        result.values.push_back(
            i < 12 ? Estimate{x, x / 10, x - 1, x + 1} : Estimate{0, kNan, 0, 0.25});
    }
    result.sunlit_fraction = {{0.5, 0.1, 0.4, 0.6}, {0, kNan, 0, 0.1}};
    result.ratio_values = {{1.25, 0.01, 1.2, 1.3}, {kNan, kNan, kNan, kNan}};
    result.budget.resize(2);
    result.budget[1].emitted = {7, .5, 6, 8};
    result.paths = 4;
    result.replicates = 8;
    return result;
}

std::string csv_text() {
    std::string text;
    write_csv(small_run(), small_result(), [&](std::string_view piece) { text += piece; });
    return text;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    LineScanner scanner(text);
    while (scanner.next()) {
        lines.emplace_back(scanner.line());
    }
    return lines;
}

/// The lines that are no comments.
std::vector<std::string> table_of(const std::string& text) {
    std::vector<std::string> lines = lines_of(text);
    std::erase_if(lines, [](const std::string& line) { return line.starts_with('#'); });
    return lines;
}

TEST(WriteCsv, HasAHeaderLineAndARowForEachOrgan) {
    const std::vector<std::string> table = table_of(csv_text());
    ASSERT_EQ(table.size(), 3U);
    EXPECT_TRUE(
        table[0].starts_with("id,name,plant,label_area,kind,area,absorbed_flux_R,absorbed_flux_R_"
                             "se,absorbed_flux_R_ci95_high,"));
    EXPECT_TRUE(table[0].ends_with(
        ",sunlit_fraction,sunlit_fraction_se,sunlit_fraction_ci95_high,ratio_R:FR,"
        "ratio_R:FR_se,ratio_R:FR_ci95_high"));
    // absorbed_flux_density_R is value 2 of the first organ
    EXPECT_TRUE(table[1].starts_with("1,\"a \"\"b\"\", #c\",1,x,,2,0,0,1,2,0.2,3,")) << table[1];
    EXPECT_TRUE(table[1].ends_with(",0.5,0.1,0.6,1.25,0.01,1.3"));
}

TEST(WriteCsv, LeavesErrorsEmptyWhereNothingWasHit) {
    const std::vector<std::string> table = table_of(csv_text());
    EXPECT_TRUE(table[2].starts_with("2,d,,,leaf,0.5,0,,0.25,0,,0.25,")) << table[2];
    EXPECT_TRUE(table[2].ends_with(",0,,0.1,,,"));
}

/// A mean beyond what is possible is written as the end of its interval.
TEST(WriteCsv, HasMeansInTheirIntervals) {
    Result result = small_result();
    result.values[2] = {13.5, 9.3, 0.4, 1.236};
    result.sunlit_fraction[0] = {1.23, 0.2, 0.67, 1};
    std::string text;
    write_csv(small_run(), result, [&](std::string_view piece) { text += piece; });
    const std::vector<std::string> table = table_of(text);
    EXPECT_TRUE(table[1].starts_with("1,\"a \"\"b\"\", #c\",1,x,,2,0,0,1,1.236,9.3,1.236,"))
        << table[1];
    EXPECT_TRUE(table[1].ends_with(",1,0.2,1,1.25,0.01,1.3")) << table[1];
    text.clear();
    write_json(small_run(), result, [&](std::string_view piece) { text += piece; });
    const auto json = nlohmann::json::parse(text);
    EXPECT_EQ(json["organs"][0]["absorbed_flux_density"]["R"]["mean"], 1.236);
    EXPECT_EQ(json["organs"][0]["absorbed_flux_density"]["R"]["ci95_high"], 1.236);
    EXPECT_EQ(json["organs"][0]["sunlit_fraction"]["mean"], 1);
}

TEST(WriteCsv, NamesTheUnitOfEveryColumn) {
    const std::vector<std::string> lines = lines_of(csv_text());
    EXPECT_TRUE(mentions(lines, "# column area [cm2]"));
    EXPECT_TRUE(mentions(lines, "# column absorbed_flux_R [1e-4 W]: "));
    EXPECT_TRUE(mentions(lines, "# column incident_upper_FR [W m-2]: "));
    EXPECT_TRUE(mentions(lines, "# column ratio_R:FR [1]: "));
}

TEST(WriteCsv, SaysWhereItCameFrom) {
    const std::vector<std::string> lines = lines_of(csv_text());
    EXPECT_TRUE(mentions(lines, "# title: a, b"));
    EXPECT_TRUE(mentions(lines, "seed = 1"));
    EXPECT_TRUE(mentions(lines, "# source: directional: azimuth 0 deg, elevation 90 deg; R 1 "));
    EXPECT_TRUE(mentions(lines, "# axes: up z, north (0, 1, 0); length unit cm"));
}

TEST(WriteCsv, EveryLineBeforeTheHeaderIsAComment) {
    const std::vector<std::string> lines = lines_of(csv_text());
    bool table_began = false;
    for (const std::string& line : lines) {
        table_began = table_began || line.starts_with("id,");
        EXPECT_EQ(line.starts_with('#'), !table_began) << line;
    }
}

TEST(WriteCsv, KeepsEachCommentOnALineWhateverThingsAreCalled) {
    RunText text;
    text.top = "bands = ['R', 'FR']\nirradiance_unit = \"W\\nm-2\"\n";
    text.run = "[run]\ngroups = [\"a\\n= 1\"]\nratios = ['R:FR']\n";
    text.organs =
        "[[organ]]\nname = \"b\\nc = 1\"\nlabels = { \"a\\n= 1\" = \"=\\n1\" }\nmaterial = 'leaf'\n"
        "shape = 'triangle'\ncorners = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]\n";
    std::string csv;
    write_csv(
        read_text(text.text()), small_result(), [&](std::string_view piece) { csv += piece; });
    const std::string header = "\nid,name,\"a\n= 1\",area,";
    ASSERT_NE(csv.find(header), std::string::npos) << csv;
    for (const std::string& line : lines_of(csv.substr(0, csv.find(header)))) {
        EXPECT_TRUE(line.starts_with('#')) << line;
    }
    EXPECT_NE(csv.find("\n1,\"b\nc = 1\",\"=\n1\",0.5,"), std::string::npos) << csv;
}

nlohmann::ordered_json json_of(const RunFile& run, const Result& result) {
    std::string text;
    write_json(run, result, [&](std::string_view piece) { text += piece; });
    return nlohmann::ordered_json::parse(text);
}

TEST(WriteJson, HoldsTheOrgansWithTheirEstimates) {
    const auto json = json_of(small_run(), small_result());
    const auto& organ = json["organs"][0];
    EXPECT_EQ(organ["name"], "a \"b\", #c");
    EXPECT_EQ(organ["labels"]["plant"], "1");
    EXPECT_EQ(organ["absorbed_flux_density"]["R"]["mean"], 2.0);
    EXPECT_EQ(organ["absorbed_flux_density"]["FR"]["standard_error"], 0.3);
    EXPECT_EQ(organ["absorbed_flux_density"]["FR"]["ci95_low"], 2.0);
    EXPECT_EQ(organ["ratios"]["R:FR"]["mean"], 1.25);
    EXPECT_TRUE(json["organs"][1]["absorbed_flux"]["R"]["standard_error"].is_null());
    EXPECT_EQ(json["organs"][1]["sunlit_fraction"]["ci95_high"], 0.1);
    EXPECT_EQ(json["energy"]["FR"]["emitted"], 7.0);
    EXPECT_EQ(json["energy"]["FR"]["emitted_standard_error"], .5);
}

TEST(WriteJson, HoldsTheWholeRunFile) {
    const auto json = json_of(small_run(), small_result());
    EXPECT_EQ(json["run_file"]["run"]["paths"], 65536);
    EXPECT_EQ(json["run_file"]["organ"].size(), 2U);
    EXPECT_EQ(json["run_file"]["organ"][1]["corners"][1][0], 1);
    EXPECT_EQ(json["format"], "quasimc-result");
}

/// Two groups, as of a run with groups = ["kind"].
Result grouped_result() {
    Result result = small_result();
    GroupResults& groups = result.groups;
    groups.groups = {
        {.by = "all", .value = "", .organs = {0, 1}, .area = 2.5},
        {.by = "layer",
         .value = "1",
         .organs = {1},
         .area = .5,
         .height_min = 0,
         .height_max = 2,
         .plant_area_index = .25,
         .cumulative_plant_area_index = .75}};
    groups.bands = 2;
    groups.ratios = 1;
    groups.values = result.values;
    groups.sunlit_fraction = result.sunlit_fraction;
    groups.sunlit_area = {{1.25, .25, 1, 1.5}, {0, kNan, 0, .05}};
    groups.ratio_values = result.ratio_values;
    result.canopy.resize(2);
    result.canopy[1].incident = 9;
    result.canopy[1].reflectance = {.125, .01, .1, .15};
    result.canopy[1].transmittance = {kNan, kNan, kNan, kNan};
    return result;
}

// A writer keeps the run that it is made for.
static_assert(!std::is_constructible_v<CsvWriter, RunFile, TextSink>);
static_assert(!std::is_constructible_v<JsonWriter, RunFile>);
static_assert(!std::is_constructible_v<Summary, RunFile>);
static_assert(std::is_constructible_v<CsvWriter, const RunFile&, TextSink>);

std::string groups_text(const RunFile& run) {
    std::string text;
    CsvWriter groups(
        run, [&](std::string_view piece) { text += piece; }, CsvRows::groups);
    groups.on_time_step({0, grouped_result()});
    return text;
}

TEST(WriteGroups, HasARowForEachGroup) {
    const std::vector<std::string> table = table_of(groups_text(small_run()));
    ASSERT_EQ(table.size(), 3U);
    EXPECT_TRUE(table[0].starts_with(
        "by,value,organs,area,height_min,height_max,plant_area_index,cumulative_plant_area_index,"
        "absorbed_flux_R,absorbed_flux_R_se,absorbed_flux_R_ci95_high,"))
        << table[0];
    EXPECT_NE(
        table[0].find(",sunlit_area,sunlit_area_se,sunlit_area_ci95_high,ratio_R:FR,"),
        std::string::npos);
    EXPECT_TRUE(table[0].ends_with(
        ",ground_absorptance_FR,ground_absorptance_FR_se,ground_absorptance_FR_ci95_high"));
    EXPECT_TRUE(table[1].starts_with("all,,2,2.5,,,,,0,0,1,2,0.2,3,")) << table[1];
    EXPECT_NE(table[1].find(",0.125,0.01,0.15,,,,"), std::string::npos) << "R of FR, no T";
    EXPECT_TRUE(table[2].starts_with("layer,1,1,0.5,0,2,0.25,0.75,0,,0.25,")) << table[2];
    EXPECT_EQ(
        std::count(table[0].begin(), table[0].end(), ','),
        std::count(table[1].begin(), table[1].end(), ','));
    EXPECT_EQ(
        std::count(table[0].begin(), table[0].end(), ','),
        std::count(table[2].begin(), table[2].end(), ','));
}

TEST(WriteGroups, NamesItsColumns) {
    const std::vector<std::string> lines = lines_of(groups_text(small_run()));
    EXPECT_TRUE(mentions(lines, "# column area [cm2]: their one-sided area"));
    EXPECT_TRUE(mentions(lines, "# column absorbed_flux_R [1e-4 W]: "));
    EXPECT_TRUE(mentions(lines, "# column reflectance_BAND [1]: "));
}

TEST(WriteJson, HoldsGroupsAndFractions) {
    const auto json = json_of(small_run(), grouped_result());
    ASSERT_EQ(json["groups"].size(), 2U);
    EXPECT_EQ(json["groups"][0]["by"], "all");
    EXPECT_EQ(json["groups"][0]["organs"], 2);
    EXPECT_FALSE(json["groups"][0].contains("height_min"));
    EXPECT_EQ(json["groups"][1]["cumulative_plant_area_index"], .75);
    EXPECT_EQ(json["groups"][0]["absorbed_flux"]["FR"]["mean"], 1.0);
    EXPECT_EQ(json["groups"][0]["sunlit_area"]["mean"], 1.25);
    EXPECT_EQ(json["groups"][0]["ratios"]["R:FR"]["mean"], 1.25);
    EXPECT_EQ(json["canopy"]["FR"]["incident"], 9.0);
    EXPECT_EQ(json["canopy"]["FR"]["reflectance"]["standard_error"], .01);
    EXPECT_TRUE(json["canopy"]["FR"]["transmittance"]["mean"].is_null());
    EXPECT_FALSE(json_of(small_run(), small_result()).contains("canopy"));
}

/// The small run, of which only a part is written.
RunFile chosen_run() {
    RunFile run = small_run();
    run.output.quantities = {"incident_upper"};
    run.output.bands = {"FR"};
    return run;
}

TEST(WrittenColumns, AreThoseAskedFor) {
    std::string text;
    write_csv(chosen_run(), small_result(), [&](std::string_view piece) { text += piece; });
    EXPECT_EQ(
        table_of(text)[0],
        "id,name,plant,label_area,kind,area,incident_upper_FR,incident_upper_FR_se,"
        "incident_upper_FR_ci95_high,ratio_R:FR,ratio_R:FR_se,ratio_R:FR_ci95_high");
    EXPECT_TRUE(table_of(text)[1].ends_with(",2,5,0.5,6,1.25,0.01,1.3")) << table_of(text)[1];
    EXPECT_EQ(table_of(groups_text(chosen_run()))[0].find("absorbed_flux"), std::string::npos);
    const auto json = json_of(chosen_run(), grouped_result());
    EXPECT_EQ(json["quantities"].size(), 1U);
    EXPECT_FALSE(json["organs"][0].contains("absorbed_flux"));
    EXPECT_FALSE(json["organs"][0].contains("sunlit_fraction"));
    EXPECT_FALSE(json["organs"][0]["incident_upper"].contains("R"));
    EXPECT_EQ(json["organs"][0]["incident_upper"]["FR"]["mean"], 5.0);
}

/// A result is compared with another whatever was written of it.
TEST(WrittenColumns, DoNotChangeTheDigest) {
    EXPECT_EQ(
        digest_of_organs(chosen_run(), small_result()),
        digest_of_organs(small_run(), small_result()));
    std::string text;
    EXPECT_EQ(
        write_json(chosen_run(), small_result(), [&](std::string_view piece) { text += piece; }),
        digest_of_organs(small_run(), small_result()));
}

TEST(WriteJson, DigestTellsResultsApart) {
    const RunFile run = small_run();
    Result result = small_result();
    const std::string digest = digest_of_organs(run, result);
    EXPECT_EQ(json_of(run, result)["organs_sha256"], digest);
    EXPECT_EQ(digest_of_organs(run, result), digest);
    result.values[3].mean = std::nextafter(result.values[3].mean, 9.0);
    EXPECT_NE(digest_of_organs(run, result), digest);
}

TEST(Summary, IsShortAndTellsTheEnergy) {
    const std::string text = summary(small_run(), small_result(), {"a.csv"});
    EXPECT_LE(lines_of(text).size(), 12U) << text;
    EXPECT_NE(text.find("FR [1e-4 W]: emitted 7 +- 0.5"), std::string::npos) << text;
    EXPECT_NE(text.find("written   a.csv"), std::string::npos) << text;
}

/// What was emitted, with what roulette added, is what the parts are together.
TEST(Summary, TellsOfEnergyThatAddsUp) {
    Result result = small_result();
    BandBudget& budget = result.budget[0];
    budget.emitted = {20.5, 0, 20.5, 20.5};
    budget.imbalance.mean = -.0016;
    budget.absorbed_by_organs = {1.86, .01, 1.8, 1.9};
    budget.absorbed_by_ground = {2, 0, 2, 2};
    budget.escaped.mean = 16.6384;
    const std::string text = summary(small_run(), result, {});
    EXPECT_NE(
        text.find("R [1e-4 W]: emitted 20.5, imbalance -0.0016; organs 1.86 +- "
                  "0.01, ground 2, escaped 16.6384, cut off 0\n"),
        std::string::npos)
        << text;
}

TEST(Summary, GivesZerosNoSign) {
    Result result = small_result();
    BandBudget& budget = result.budget[0];
    budget.emitted = {20.5, 0, 20.5, 20.5};
    budget.absorbed_by_organs = {20.5, 0, 20.5, 20.5};
    budget.escaped = {-3e-15, 1e-16, -3e-15, -3e-15};
    result.canopy.resize(2);
    result.canopy[0].incident = 20.5;
    result.canopy[0].reflectance = {-1e-17, 0, -1e-17, -1e-17};
    std::string text = summary(small_run(), result, {});
    EXPECT_NE(text.find("escaped 0, cut off 0\n"), std::string::npos) << text;
    EXPECT_NE(text.find("albedo 0.0000"), std::string::npos) << text;
    budget.emitted.mean = 2e6;
    budget.escaped.mean = -3e-10;
    text = summary(small_run(), result, {});
    EXPECT_NE(text.find("escaped 0, cut off 0"), std::string::npos) << text;
}

/// The percentage is that of the organs that are at the target.
TEST(Summary, TellsHowManyOrgansReachedTheTarget) {
    Result result = small_result();
    result.stop = StopReason::path_limit;
    result.fraction_at_target = 0.05625;
    RunFile run = small_run();
    run.spec.target_error = 0.07;
    const std::string text = summary(run, result, {});
    EXPECT_NE(
        text.find("target    not reached: 5.62 % of the organs are within 7 % (95 % required)\n"),
        std::string::npos)
        << text;
}

TEST(Summary, TellsOfErrorsInWords) {
    Result result = small_result();
    std::string text = summary(small_run(), result, {});
    EXPECT_NE(text.find("median 10 %, largest 10 % (organ "), std::string::npos) << text;
    EXPECT_EQ(text.find("advice"), std::string::npos) << text;
    for (Estimate& estimate : result.values) {
        estimate.standard_error = estimate.mean;
    }
    text = summary(small_run(), result, {});
    EXPECT_NE(text.find(", above 50 % for 1 of 2 organs (largest: organ "), std::string::npos)
        << text;
    EXPECT_EQ(text.find("e+02"), std::string::npos) << text;
    EXPECT_NE(text.find("advice    to reach 5 %: --target-error 0.05\n"), std::string::npos)
        << text;
}

/// The light of the other organs is not reported.
TEST(Summary, CountsTheErrorsOfMeasuredOrgans) {
    Result result = small_result();
    EXPECT_NE(summary(small_run(), result, {}).find("; none for 2 organs ("), std::string::npos);
    for (Estimate& estimate : result.values) {
        estimate.standard_error = estimate.mean;
    }
    const std::string text = summary(small_run("measured = false\n"), result, {});
    EXPECT_NE(text.find(", above 50 % for 1 of 1 organ (largest: organ "), std::string::npos)
        << text;
    EXPECT_NE(text.find("; none for 1 organ ("), std::string::npos) << text;
}

TEST(Summary, TellsThatTheTimeWasUp) {
    Result result = small_result();
    result.stop = StopReason::time_limit;
    RunFile run = small_run();
    run.spec.max_seconds = 2;
    run.spec.paths = 16;
    EXPECT_NE(
        summary(run, result, {}).find("stopped   max_seconds = 2 reached: 4 of 16 paths completed"),
        std::string::npos);
    EXPECT_EQ(json_of(run, result)["completed"]["stop"], "time_limit");
    result.stop = StopReason::interrupted;
    EXPECT_NE(summary(run, result, {}).find("stopped   interrupted: 4 of 16"), std::string::npos);
    EXPECT_EQ(json_of(run, result)["completed"]["stop"], "interrupted");
}

/// Every form of the result has the choice of "auto" and its reason.
TEST(Summary, HasTheFractionsOfTheCanopy) {
    EXPECT_TRUE(mentions(
        lines_of(summary(small_run(), grouped_result(), {})),
        "canopy    FR: absorbed 0.0000, albedo 0.1250 +- 0.01, ground 0.0000"));
    EXPECT_FALSE(mentions(lines_of(summary(small_run(), small_result(), {})), "canopy"));
}

TEST(Summary, HasALineForEachOriginOfLight) {
    Result result = small_result();
    for (const char* name : {"sun", "sky"}) {
        result.origins.push_back({name, small_result()});
    }
    result.origins.front().light.budget[0].emitted.mean = 1234;
    const auto lines = lines_of(summary(small_run(), result, {}));
    EXPECT_TRUE(mentions(lines, "origin    sun: R ["));
    EXPECT_TRUE(mentions(lines, "emitted 1234"));
    EXPECT_TRUE(mentions(lines, "origin    sky: FR ["));
    EXPECT_FALSE(mentions(lines_of(summary(small_run(), small_result(), {})), "origin"));
}

TEST(Method, IsToldWithItsReason) {
    RunFile run = small_run();
    run.spec.method = Method::automatic;
    Result result = small_result();
    result.chosen = {Method::first_hits, "it is sunny"};
    EXPECT_NE(
        summary(run, result, {}).find("method    first_hits (automatic): it is sunny"),
        std::string::npos);
    const auto json = json_of(run, result)["method"];
    EXPECT_EQ(json["used"], "first_hits");
    EXPECT_EQ(json["requested"], "auto");
    EXPECT_EQ(json["reason"], "it is sunny");
    std::string table;
    write_csv(run, result, [&](std::string_view piece) { table += piece; });
    EXPECT_TRUE(mentions(lines_of(table), "# method: first_hits, it is sunny"));
}

TEST(Method, IsNoNewsToWhoAskedForIt) {
    Result result = small_result();
    result.chosen = {Method::light_tracing, "the reason"};
    RunFile run = small_run();
    run.spec.method = Method::light_tracing;
    const std::string text = summary(run, result, {});
    EXPECT_NE(text.find("method    light_tracing (requested)\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("the reason"), std::string::npos);
}

Audit small_audit(double chance) {
    return {
        10,
        8,
        {{.reduced_chi_square = 1.5, .freedom = 3, .difference = -2, .standard_error = 1},
         {.reduced_chi_square = .5, .difference = kNan, .standard_error = kNan}},
        chance};
}

TEST(Audit, IsToldBandByBand) {
    Result result = small_result();
    EXPECT_TRUE(json_of(small_run(), result)["audit"].is_null());
    EXPECT_EQ(summary(small_run(), result, {}).find("audit"), std::string::npos);
    result.audit = small_audit(.25);
    const auto json = json_of(small_run(), result)["audit"];
    EXPECT_EQ(json["agrees"], true);
    EXPECT_EQ(json["paths"], 10);
    EXPECT_EQ(json["bands"]["R"]["reduced_chi_square"], 1.5);
    EXPECT_EQ(json["bands"]["R"]["difference"], -2.0);
    EXPECT_EQ(json["bands"]["R"]["unit"], "1e-4 W");
    EXPECT_TRUE(json["bands"]["FR"]["difference"].is_null());
    const std::string text = summary(small_run(), result, {});
    EXPECT_NE(text.find("audit     agrees"), std::string::npos) << text;
    EXPECT_NE(
        text.find("R: reduced chi-square 1.5; organs absorb 0.0002 +- 0.0001 W less"),
        std::string::npos);
}

TEST(Audit, IsLoudWhenItDisagrees) {
    Result result = small_result();
    result.audit = small_audit(kAuditLevel / 2);
    EXPECT_EQ(json_of(small_run(), result)["audit"]["agrees"], false);
    EXPECT_NE(summary(small_run(), result, {}).find("audit     DISAGREES"), std::string::npos);
    EXPECT_NE(audit_warning(result.audit->p_value).find("do not trust"), std::string::npos);
    EXPECT_EQ(audit_warning(kAuditLevel), "");
    SeriesSummary series;
    EXPECT_EQ(audit_line(series), "");
    series.audited = 3;
    series.audit_p_value = 0;
    EXPECT_NE(audit_line(series).find("DISAGREES"), std::string::npos);
}

TEST(FluxUnit, TakesTheAreaOutWhereItCan) {
    EXPECT_EQ(flux_unit("W m-2", "m"), "W");
    EXPECT_EQ(flux_unit("umol m-2 s-1", "m"), "umol s-1");
    EXPECT_EQ(flux_unit("W m-2", "cm"), "1e-4 W");
    EXPECT_EQ(flux_unit("W cm-2", "cm"), "W");
    EXPECT_EQ(flux_unit("W cm-2", "m"), "1e4 W");
    EXPECT_EQ(flux_unit("umol m-2 s-1", "mm"), "1e-6 umol s-1");
    EXPECT_EQ(flux_unit("W m-2", "ft"), "0.09290304 W");
    EXPECT_EQ(flux_unit("W m-2", "voxel"), "W m-2 voxel2");
    EXPECT_EQ(flux_unit("lx", "m"), "lm");
    EXPECT_EQ(flux_unit("lx", "cm"), "1e-4 lm");
    EXPECT_EQ(flux_unit("m-2", "m"), "1");
    EXPECT_EQ(flux_unit("W", "m"), "W m2");
}

}  // namespace
}  // namespace quasimc::test

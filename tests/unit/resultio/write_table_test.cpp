// The tables of [[table]].

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "quasimc/run.h"
#include "quasimc/series.h"
#include "resultio/output_input.h"
#include "text/line_scanner.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

const std::string kTable = "[[table]]\nfile = 'table.csv'\n";

/// Two leaves of two plants and a stem over a ground.
RunText tabulated(const std::string& table, const std::string& rest = "") {
    RunText text;
    text.top = "bands = ['R', 'FR']\n";
    text.run = "[run]\npaths = 64\nratios = ['R:FR']\ngroups = ['plant', 'plant+kind']\n";
    const auto organ = [](const std::string& labels, int height) {
        return "[[organ]]\nmaterial = 'leaf'\nlabels = " + labels +
               "\nshape = 'triangle'\ncorners = [[0, 0, " + std::to_string(height) + "], [2, 0, " +
               std::to_string(height) + "], [0, 2, " + std::to_string(height) + "]]\n";
    };
    text.organs = organ("{ plant = 1, kind = 'leaf' }", 1) +
                  organ("{ plant = 2, kind = 'leaf', value = 'x' }", 2) +
                  organ("{ plant = 2, kind = 'stem' }", 3);
    text.rest = "[ground]\nmaterial = 'leaf'\nx = [-1, 3]\ny = [-1, 3]\n" + rest + kTable + table;
    return text;
}

std::vector<std::string> rows_of(const std::string& text) {
    std::vector<std::string> rows;
    LineScanner scanner(text);
    while (scanner.next()) {
        if (!scanner.line().starts_with('#')) {
            rows.emplace_back(scanner.line());
        }
    }
    return rows;
}

/// The text of the first table.
std::string written_table(const RunText& text) {
    const RunFile run = read_text(text.text());
    std::string out;
    const TextSink sink = [&](std::string_view piece) { out += piece; };
    const TableSpec& table = run.output.tables.at(0);
    const auto writer = make_table({run, sink, table.file, table.location, &table});
    const Result result = quasimc::run(run.scene, run.sources, run.spec);
    writer->on_time_step({0, result});
    writer->finish({});
    return out;
}

TEST(Tables, HaveTheirFileBesideTheRunFile) {
    const RunFile run = read_text(tabulated("rows = 'groups'\n").text());
    ASSERT_EQ(run.output.tables.size(), 1U);
    EXPECT_EQ(run.output.tables[0].file, "/run/table.csv");
    EXPECT_EQ(run.output.tables[0].rows, CsvRows::groups);
}

TEST(Tables, OfOrgansHaveTheQuantitiesAndStatisticsThatAreRequested) {
    const auto rows = rows_of(written_table(
        tabulated("quantities = ['absorbed_flux', 'ratios']\nbands = ['FR']\n"
                  "statistics = ['mean', 'ci95_low']\nwhere = \"plant == 2 and height > 1.5\"\n")));
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(
        rows[0],
        "id,name,area,plant,kind,value,absorbed_flux_FR,absorbed_flux_FR_ci95_low,ratio_R:FR,"
        "ratio_R:FR_ci95_low");
    EXPECT_TRUE(rows[1].starts_with("2,organ 2,2,2,leaf,x,")) << rows[1];
    EXPECT_TRUE(rows[2].starts_with("3,organ 3,2,2,stem,,2,1.99")) << rows[2];
}

TEST(Tables, OfGroupsHaveColumnsOfTheirKeysAndShares) {
    const auto rows = rows_of(written_table(
        tabulated("rows = 'groups'\nwhere = \"by == 'plant+kind' and plant in [1, 2]\"\n"
                  "quantities = ['fraction_absorbed']\nbands = ['R']\nstatistics = ['mean']\n")));
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0], "by,value_of,organs,area,plant,kind,fraction_absorbed_R");
    // The light comes from above: the stem has all of it.
    EXPECT_EQ(rows[1], "plant+kind,1+leaf,1,2,1,leaf,0");
    EXPECT_EQ(rows[3], "plant+kind,2+stem,1,2,2,stem,1");
}

TEST(Tables, InLongFormHaveARowForEachNumber) {
    const auto rows = rows_of(written_table(
        tabulated("form = 'long'\nquantities = ['incident_upper', 'sunlit_fraction']\ndigits = 3\n"
                  "statistics = ['mean', 'ci95_high']\nwhere = \"kind == 'stem'\"\n")));
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0], "id,name,area,plant,kind,label_value,quantity,band,unit,value,ci95_high");
    EXPECT_EQ(rows[1], "3,organ 3,2,2,stem,,incident_upper,R,W m-2,1,1");
    EXPECT_EQ(rows[2], "3,organ 3,2,2,stem,,incident_upper,FR,W m-2,1,1");
    EXPECT_EQ(rows[3], "3,organ 3,2,2,stem,,sunlit_fraction,,1,1,1");
}

/// A wide table of groups has the numbers of groups_csv.
TEST(Tables, HaveTheNumbersOfTheShortForm) {
    const RunText text = tabulated("rows = 'groups'\n");
    const RunFile run = read_text(text.text());
    const Result result = quasimc::run(run.scene, run.sources, run.spec);
    std::string out;
    CsvWriter groups(
        run, [&](std::string_view piece) { out += piece; }, CsvRows::groups);
    groups.on_time_step({0, result});
    const auto with = rows_of(written_table(text)), without = rows_of(out);
    ASSERT_EQ(with.size(), without.size());
    const std::string light = "absorbed_flux_R,";
    const auto columns_from = [](const std::string& row, std::size_t column) {
        std::size_t at = 0;
        for (std::size_t i = 0; i < column; ++i) {
            at = row.find(',', at) + 1;
        }
        return row.substr(at);
    };
    for (std::size_t i = 0; i < with.size(); ++i) {
        EXPECT_EQ(columns_from(with[i], 6).substr(0, 2000), columns_from(without[i], 8)) << i;
    }
}

TEST(Tables, HaveTheLightOfEachOriginOrOfSome) {
    const auto with_origins = [](const std::string& keys) {
        RunText text = tabulated(keys);
        text.run += "origins = ['directional']\n";
        return text;
    };
    const std::string all =
        "quantities = ['absorbed_flux']\nbands = ['R']\nstatistics = ['mean']\n";
    const auto wide = rows_of(written_table(with_origins(all)));
    EXPECT_NE(wide[0].find("absorbed_flux_R,absorbed_flux_R_from_"), std::string::npos) << wide[0];
    const auto none = rows_of(written_table(with_origins(all + "origins = []\n")));
    EXPECT_TRUE(none[0].ends_with("absorbed_flux_R")) << none[0];
    const auto narrow = rows_of(written_table(with_origins(all + "form = 'long'\n")));
    EXPECT_NE(narrow[0].find("quantity,band,origin,unit,value"), std::string::npos) << narrow[0];
    EXPECT_NE(narrow[1].find("absorbed_flux,R,all,"), std::string::npos) << narrow[1];
    EXPECT_NE(narrow[2].find("absorbed_flux,R,"), std::string::npos) << narrow[2];
    EXPECT_EQ(narrow[2].find(",all,"), std::string::npos) << narrow[2];
    EXPECT_TRUE(mentions(
        faults_of(with_origins("origins = ['moon']\n").text()),
        "origins: the run has no origin 'moon'"));
}

TEST(Tables, DaysHaveDatesAndSums) {
    const RunText text = tabulated(
        "rows = 'groups'\nper = 'day'\nform = 'long'\nquantities = ['absorbed_flux']\n",
        "[site]\nlatitude_deg = 50\nlongitude_deg = 8\n[time]\nday = '2024-06-21'\n"
        "utc_offset_hours = 1\nhours = [11, 13]\n");
    const RunFile run = read_text(text.text());
    std::string out;
    const TableSpec& table = run.output.tables.at(0);
    const auto writer =
        make_table({run, [&](std::string_view piece) { out += piece; }, table.file, "", &table});
    EXPECT_TRUE(writer->wants(SeriesPart::days));
    EXPECT_FALSE(writer->wants(SeriesPart::time_steps));
    const auto rows = rows_of(out);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(
        rows[0],
        "date,seconds,by,value_of,organs,area,plant,kind,quantity,band,unit,value,se,ci95_high");
}

/// The text of every table of a run with [time].
std::vector<std::string> written_sums(const RunText& text, std::size_t completed_less = 0) {
    const RunFile run = read_text(text.text());
    std::vector<std::string> texts(run.output.tables.size());
    std::vector<std::unique_ptr<OutputWriter>> writers;
    RunControl control;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const TextSink sink = [&texts, i](std::string_view piece) { texts[i] += piece; };
        writers.push_back(make_table({run, sink, "", "", &run.output.tables[i]}));
        control.listeners.push_back(writers.back().get());
    }
    SeriesSummary summary = run_series(run.scene, run.series->time_steps, run.spec, control);
    summary.completed -= completed_less;
    for (const auto& writer : writers) {
        writer->finish(summary);
    }
    return texts;
}

const std::string kTwoDays =
    "[site]\nlatitude_deg = 50\nlongitude_deg = 8\n[time]\nfrom = '2024-06-21'\n"
    "to = '2024-06-22'\nutc_offset_hours = 1\nhours = [11, 13]\n";
const std::string kSumsOfPlants =
    "rows = 'groups'\nwhere = \"by == 'plant'\"\nquantities = ['absorbed_flux']\nbands = ['R']\n"
    "statistics = ['mean', 'se']\n";

double number_at(const std::string& row, std::size_t column) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < column; ++i) {
        begin = row.find(',', begin) + 1;
    }
    return std::stod(row.substr(begin));
}

/// The days of a period are independent: means add up, and squares of standard errors.
TEST(Tables, OfAPeriodHaveTheSumOfItsDays) {
    const auto texts = written_sums(tabulated(
        kSumsOfPlants + "per = 'day'\n[[table]]\nfile = 'period.csv'\n" + kSumsOfPlants +
            "per = 'period'\n",
        kTwoDays));
    const auto days = rows_of(texts.at(0)), period = rows_of(texts.at(1));
    ASSERT_EQ(days.size(), 5U);
    ASSERT_EQ(period.size(), 3U);
    EXPECT_EQ(period[0], days[0]);
    EXPECT_NE(texts[0].find("absorbed_flux_R [J d-1]"), std::string::npos) << texts[0];
    EXPECT_NE(texts[1].find("absorbed_flux_R [J]"), std::string::npos);
    EXPECT_TRUE(period[1].starts_with("2024-06-21/2024-06-22,14400,plant,1,")) << period[1];
    constexpr std::size_t kMean = 8;
    for (std::size_t plant = 1; plant <= 2; ++plant) {
        const double first = number_at(days[plant], kMean),
                     second = number_at(days[plant + 2], kMean);
        EXPECT_GT(first, 0);
        EXPECT_NEAR(number_at(period[plant], kMean), first + second, 1e-12 * first);
        EXPECT_NEAR(
            number_at(period[plant], kMean + 1),
            std::hypot(number_at(days[plant], kMean + 1), number_at(days[plant + 2], kMean + 1)),
            1e-12 * first);
    }
}

/// The row of all organs has them, as in tables of time steps.
TEST(Tables, OfSumsHaveTheFractionsOfTheCanopy) {
    const std::string keys =
        "rows = 'groups'\nwhere = \"by == 'all'\"\nbands = ['R']\nstatistics = ['mean', 'se']\n"
        "quantities = ['absorbed_flux', 'fraction_incident', 'absorptance', 'transmittance']\n";
    const auto texts = written_sums(tabulated(
        keys + "per = 'day'\n[[table]]\nfile = 'period.csv'\n" + keys + "per = 'period'\n",
        kTwoDays));
    for (const std::string& text : texts) {
        const auto rows = rows_of(text);
        ASSERT_GE(rows.size(), 2U);
        EXPECT_NE(
            rows[0].find(",transmittance_R,transmittance_R_se,absorptance_R,absorptance_R_se"),
            std::string::npos)
            << rows[0];
        const std::size_t mean = 8, share = mean + 2, transmittance = mean + 4;
        const std::size_t absorptance = mean + 6;
        EXPECT_NEAR(number_at(rows[1], absorptance), number_at(rows[1], share), 1e-9)
            << "fAPAR is that of all organs";
        EXPECT_GT(number_at(rows[1], absorptance + 1), 0);
        EXPECT_GT(number_at(rows[1], transmittance), 0.5);
    }
}

TEST(Sums, HaveTheFractionsOfTheCanopyInJson) {
    const RunFile run = read_text(tabulated("", kTwoDays).text());
    std::string out;
    JsonWriter writer(run, [&](std::string_view piece) { out += piece; });
    writer.finish(run_series(
        run.scene, run.series->time_steps, run.spec, RunControl{.listeners = {&writer}}));
    const std::string days = out.substr(out.find("\"days\": "));
    const std::string canopy = "\"canopy\": {";
    const std::size_t first = days.find(canopy), total = days.find("\"total\": ");
    EXPECT_LT(first, total);
    EXPECT_LT(days.find(canopy, total), days.find("\"organs\": [", total));
    const std::string of_day = days.substr(first, days.find("\"groups\"", first) - first);
    EXPECT_NE(of_day.find("\"unit\": \"J\""), std::string::npos) << of_day;
    EXPECT_NE(of_day.find("\"ground_absorptance\""), std::string::npos);
}

TEST(Tables, OfAPeriodHaveNoRowsWithoutAllOfItsTimes) {
    const RunText text = tabulated(kSumsOfPlants + "per = 'period'\n", kTwoDays);
    EXPECT_EQ(rows_of(written_sums(text).at(0)).size(), 3U);
    EXPECT_EQ(rows_of(written_sums(text, 1).at(0)).size(), 1U);
}

/// Sensors above the leaves, below which there is no light.
RunText with_sensors(const std::string& table) {
    return tabulated(
        "rows = 'sensors'\n" + table,
        "[[sensors]]\nname = 'bench'\nlabels = { plant = 7 }\n"
        "at = { start = [0.2, 0.2, 0.5], along = [1, 0, 0], across = [0, 0, 10], counts = [1, 2] "
        "}\n[[sensors]]\nname = 'ball'\nreceiver = 'sphere'\nat = [[0.2, 0.2, 8]]\n");
}

TEST(Tables, OfSensorsHaveTheirPositionsAndLight) {
    const auto rows = rows_of(written_table(with_sensors(
        "quantities = ['incident_upper', 'fluence_rate']\nbands = ['R']\nstatistics = ['mean']\n"
        "digits = 6\n")));
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0], "id,name,x,y,z,sensors,plant,i,j,incident_upper_R,fluence_rate_R");
    EXPECT_EQ(rows[1], "1,bench 1,0.7,0.2,3,bench,7,1,1,1,");
    EXPECT_EQ(rows[2], "2,bench 2,0.7,0.2,8,bench,7,1,2,1,");
    EXPECT_EQ(rows[3], "3,ball 1,0.2,0.2,8,ball,,,,,1");
}

/// Nothing is above these, and the light on the horizontal is 1.
TEST(Tables, OfSensorsThatFaceUpHaveTheirTransmittance) {
    const RunText text = with_sensors(
        "quantities = ['incident_upper', 'transmittance']\nbands = ['R']\n"
        "statistics = ['mean', 'se']\n");
    const auto rows = rows_of(written_table(text));
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_TRUE(rows[0].ends_with(
        ",incident_upper_R,incident_upper_R_se,transmittance_R,transmittance_R_se"))
        << rows[0];
    for (const std::size_t row : {1, 2}) {
        EXPECT_NEAR(number_at(rows[row], 11), 1, 1e-6);
        EXPECT_DOUBLE_EQ(number_at(rows[row], 11), number_at(rows[row], 9));
        EXPECT_DOUBLE_EQ(number_at(rows[row], 12), number_at(rows[row], 10));
    }
    EXPECT_TRUE(rows[3].ends_with(",,,,")) << "a sphere: " << rows[3];
    EXPECT_TRUE(mentions(
        faults_of(tabulated(
                      "rows = 'sensors'\nquantities = ['transmittance']\n",
                      "[[sensors]]\nfacing = 'down'\nat = [[0, 0, 5]]\n")
                      .text()),
        "quantities: no sensor has a transmittance"));
}

/// A quotient of sums: at a sensor below leaves it is not the mean of quotients.
TEST(Tables, OfSumsHaveTheTransmittanceOfSensors) {
    const std::string keys =
        "rows = 'sensors'\nquantities = ['incident_upper', 'transmittance']\nbands = ['R']\n"
        "statistics = ['mean', 'se']\ndigits = 17\n";
    const auto texts = written_sums(tabulated(
        keys + "per = 'day'\n[[table]]\nfile = 'period.csv'\n" + keys + "per = 'period'\n",
        kTwoDays + "[[sensors]]\nat = [[0.5, 0.7, 9], [0.5, 0.7, 0.9]]\n"));
    const auto days = rows_of(texts.at(0)), period = rows_of(texts.at(1));
    ASSERT_EQ(days.size(), 5U);
    ASSERT_EQ(period.size(), 3U);
    constexpr std::size_t kUpper = 8;
    const auto horizontal = [&](const std::string& row) {
        return number_at(row, kUpper) / number_at(row, kUpper + 2);
    };
    for (const auto& rows : {days, period}) {
        EXPECT_NEAR(number_at(rows[1], kUpper + 2), 1, 5 * number_at(rows[1], kUpper + 3) + 1e-9);
        EXPECT_LT(number_at(rows[1], kUpper + 3), 0.05);
        EXPECT_LT(number_at(rows[2], kUpper + 2), 0.7);
        EXPECT_NEAR(horizontal(rows[1]), horizontal(rows[2]), 1e-9 * horizontal(rows[1]));
        EXPECT_NEAR(
            number_at(rows[2], kUpper + 1) / number_at(rows[2], kUpper + 3), horizontal(rows[1]),
            1e-9 * horizontal(rows[1]));
    }
    const double both = horizontal(days[1]) + horizontal(days[3]);
    EXPECT_NEAR(horizontal(period[1]), both, 1e-9 * both);
}

TEST(Tables, OfSensorsAreSelectedByLabelsAndPositions) {
    const auto rows = rows_of(written_table(with_sensors(
        "form = 'long'\nquantities = ['incident_upper']\nbands = ['R']\n"
        "statistics = ['mean']\ndigits = 6\nwhere = \"sensors == 'bench' and z > 5\"\n")));
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0], "id,name,x,y,z,sensors,plant,i,j,quantity,band,unit,value");
    EXPECT_EQ(rows[1], "2,bench 2,0.7,0.2,8,bench,7,1,2,incident_upper,R,W m-2,1");
}

TEST(Tables, OfSensorsHaveNoLightOfParts) {
    EXPECT_TRUE(mentions(
        faults_of(with_sensors("quantities = ['incident_upper_sunlit']\n").text()),
        "quantities: there is no 'incident_upper_sunlit' in such a table"));
}

/// A stopped run writes no rows of sensors that were not computed, and no text that claims some.
TEST(Sensors, OfAStoppedRunAreAbsentInFiles) {
    RunFile run = read_text(with_sensors("").text());
    run.spec.max_seconds = 2;
    Result result = quasimc::run(run.scene, run.sources, run.spec);
    result.sensors = nullptr;
    result.stop = StopReason::time_limit;
    std::string out;
    const TextSink sink = [&](std::string_view piece) { out += piece; };
    const TableSpec& table = run.output.tables.at(0);
    const auto writer = make_table({run, sink, table.file, table.location, &table});
    writer->on_time_step({0, result});
    writer->finish({});
    const std::string reason =
        "not computed, as the run was stopped before them (max_seconds = 2 reached)";
    EXPECT_NE(out.find("\n# sensors: " + reason + "\n"), std::string::npos) << out;
    EXPECT_EQ(rows_of(out).size(), 1U) << "the names of columns";
    EXPECT_NE(summary(run, result, {}).find("\nsensors   " + reason + "\n"), std::string::npos);
    out.clear();
    write_json(run, result, sink);
    EXPECT_EQ(out.rfind("\"sensors\": ["), out.find("\"sensors\": [")) << "only the run file's";
    EXPECT_GT(out.rfind("\"organs\": ["), out.rfind("\"sensors\": ["));
}

/// Both sides in JSON, and the fluence rate of a sphere; no sensor among the organs.
TEST(Sensors, AreBesideTheOrgansInJson) {
    const RunFile run = read_text(with_sensors("").text());
    const Result result = quasimc::run(run.scene, run.sources, run.spec);
    std::string out;
    write_json(run, result, [&](std::string_view piece) { out += piece; });
    const std::size_t begin = out.rfind("\"sensors\": [");
    ASSERT_NE(begin, std::string::npos);
    const std::string sensors = out.substr(begin);
    EXPECT_NE(sensors.find("\"name\":\"bench 2\""), std::string::npos);
    EXPECT_NE(sensors.find("\"position\":[0.7,0.2,8.0]"), std::string::npos);
    EXPECT_NE(sensors.find("\"fluence_rate\":{\"R\":{\"mean\":"), std::string::npos);
    EXPECT_EQ(sensors.find("absorbed_flux"), std::string::npos);
    const std::size_t ball = sensors.find("\"name\":\"ball 1\"");
    EXPECT_NE(sensors.find("\"transmittance\":{\"R\":{\"mean\":"), std::string::npos);
    EXPECT_LT(sensors.rfind("\"transmittance\""), ball) << "a sphere has none";
    const std::string organs = out.substr(out.rfind("\"organs\": ["), begin);
    EXPECT_EQ(organs.substr(0, organs.find("\"sensors\": [")).find("bench"), std::string::npos);
}

TEST(Tables, FaultsSayWhatToDo) {
    const std::vector<std::pair<std::string, std::string>> table{
        {"rows = 'group'\n", "rows: 'group' is not one of organs, groups, sensors, detectors"},
        {"form = 'short'\n", "form: 'short' is not one of wide, long"},
        {"per = 'day'\n", "per = \"day\" without [time]"},
        {"per = 'period'\n", "per = \"period\" without [time]"},
        {"rows = 'control'\nper = 'period'\n", "per = \"period\" in a table of controls"},
        {"quantities = ['absorbed_fluxx']\n",
         "quantities: there is no 'absorbed_fluxx' in such a table; did you mean 'absorbed_flux'?"},
        {"quantities = ['sunlit_area']\n", "there is no 'sunlit_area' in such a table"},
        {"bands = ['B']\n", "bands: there is no 'B'"},
        {"statistics = ['median']\n", "statistics: there is no 'median'"},
        {"statistics = []\n", "statistics is empty"},
        {"quantities = []\n",
         "quantities is empty (nothing would be written); name some, or leave it out for all"},
        {"bands = []\n", "bands is empty"},
        {"[output]\nbands = []\n", "[output]: bands is empty"},
        {"origins = ['lamp']\n", "table 'table.csv': origins: the run has no origin 'lamp'"},
        {"digits = 0\n", "digits is 0 (it must be 1 to 17)"},
        {"where = \"kimd == 'leaf'\"\n",
         "table 'table.csv': where: unknown label 'kimd' in \"kimd == 'leaf'\" (labels are plant, "
         "kind, value, id, "
         "name, material, area, height); did you mean 'kind'?"},
        {"where = \"kind = 'leaf'\"\n",
         "where: \"kind = 'leaf'\": '=' sets nothing here; compare with '=='"},
        {"rows = 'groups'\nwhere = \"name == 'a'\"\n", "where: unknown label 'name'"},
        {"rows = 'detectors'\n", "rows = \"detectors\" without [[detector]]"},
        {"rows = 'detectors'\ndigits = 3\n", "digits in a table of detectors"},
        {"sums = true\n", "unknown key 'sums'"},
        {kTable, "table.csv is the file of another output"},
        {"[output]\ncsv = 'table.csv'\n", "table.csv is the file of another output"}};
    for (const auto& [keys, problem] : table) {
        const auto faults = faults_of(tabulated(keys).text());
        EXPECT_TRUE(mentions(faults, problem)) << keys << ::testing::PrintToString(faults);
    }
    RunText nameless = tabulated("");
    nameless.rest += "[[table]]\n";
    EXPECT_TRUE(mentions(faults_of(nameless.text()), "table: file is missing"));
}

std::vector<std::string> warnings_of(const RunText& text) {
    std::vector<std::string> texts;
    for (const Warning& warning : read_text(text.text()).warnings) {
        texts.push_back(warning.where + ": " + warning.text);
    }
    return texts;
}

TEST(Tables, WarnOfConditionsThatNoRowFulfils) {
    const std::string problem = ": where: no row of the table fulfils \"";
    for (const auto& [keys, condition] : std::vector<std::pair<std::string, std::string>>{
             {"", "kind == 'root'"},
             {"rows = 'groups'\n", "by == 'plant' and plant == 3"},
             {"rows = 'organs'\n", "height > 10"}}) {
        const std::string where = "where = \"" + condition + "\"\n";
        EXPECT_TRUE(mentions(warnings_of(tabulated(keys + where)), problem + condition + "\""))
            << keys;
    }
    EXPECT_TRUE(
        mentions(warnings_of(with_sensors("where = \"sensors == 'bench' and z > 9\"\n")), problem));
    EXPECT_FALSE(mentions(warnings_of(tabulated("where = \"kind == 'stem'\"\n")), problem));
    EXPECT_FALSE(
        mentions(warnings_of(tabulated("rows = 'groups'\nwhere = \"by == 'all'\"\n")), problem));
}

TEST(GroupKeys, WarnOfConditionsThatNoOrganFulfils) {
    RunText text = tabulated("");
    text.run =
        "[run]\ngroups = ['plant', 'roots: plant where height < 0', 'top: where height > 1']\n";
    const auto warnings = warnings_of(text);
    EXPECT_TRUE(
        mentions(warnings, "[run]: groups: no organ belongs to \"roots: plant where height < 0\""))
        << ::testing::PrintToString(warnings);
    EXPECT_FALSE(mentions(warnings, "top"));
}

TEST(GroupKeys, AreWrittenAsTablesToo) {
    RunText text = tabulated("");
    text.run =
        "[run]\ngroups = ['plant', { name = 'top', by = 'plant', where = \"height > 1.5\" }, "
        "{ where = 'plant in [1, 2]' }]\n";
    EXPECT_EQ(
        read_text(text.text()).spec.groups,
        (std::vector<std::string>{
            "plant", "top: plant where height > 1.5", "where plant in [1, 2]"}));
    EXPECT_EQ(
        read_text(tabulated("").text(), {}, {{"groups", "plant, kind where plant in [1, 2]", "-"}})
            .spec.groups,
        (std::vector<std::string>{"plant", "kind where plant in [1, 2]"}));
    for (const auto& [group, problem] : std::vector<std::pair<std::string, std::string>>{
             {"{ name = 'a' }", "a group has neither by nor where"},
             {"{ name = 'a:b', by = 'plant' }", "the name 'a:b' has ':' or 'where'"},
             {"{ by = 3 }", "by is an integer"},
             {"{ by = 'plant', were = 'x' }", "unknown key 'were'"},
             {"{ by = 'plant', where = \"kimd == 3\" }", "unknown label 'kimd'"}}) {
        text.run = "[run]\ngroups = [" + group + "]\n";
        const auto faults = faults_of(text.text());
        EXPECT_TRUE(mentions(faults, problem)) << group << ::testing::PrintToString(faults);
    }
}

}  // namespace
}  // namespace quasimc::test

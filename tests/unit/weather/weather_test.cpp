#include "weather/weather.h"

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// A weather file and what was said of it.
struct ReadWeather {
    WeatherFile file;
    std::vector<std::string> faults;
    std::vector<std::string> warnings = {};
};

std::vector<std::string> texts_of(const std::vector<Warning>& warnings) {
    std::vector<std::string> texts;
    for (const Warning& warning : warnings) {
        texts.push_back(warning.where + ": " + warning.text);
    }
    return texts;
}

std::vector<std::string> texts_of(const Faults& faults) {
    std::vector<std::string> texts;
    try {
        faults.throw_if_any();
    } catch (const InputError& error) {
        for (const Fault& fault : error.faults()) {
            texts.push_back(fault.text());
        }
    }
    return texts;
}

ReadWeather epw(const std::string& text) {
    Reporter reporter{"w.epw", {}, {}};
    WeatherFile file = read_epw(text, reporter);
    return {std::move(file), texts_of(reporter.faults), texts_of(reporter.warnings)};
}

ReadWeather csv(const std::string& text, const WeatherColumns& columns = {}) {
    Reporter reporter{"w.csv", {}, {}};
    WeatherFile file = read_weather_csv(text, columns, reporter);
    return {std::move(file), texts_of(reporter.faults), texts_of(reporter.warnings)};
}

constexpr const char* kHead =
    "LOCATION,Wageningen,-,NLD,test,0,51.97,5.67,1.0,7.0\n"
    "DESIGN CONDITIONS,0\n"
    "DATA PERIODS,1,1,Data,Sunday,1/1,12/31\n";

std::string record(
    int year, int month, int day, int hour, const std::string& beam, const std::string& diffuse) {
    return fmt::format(
        "{},{},{},{},60,?9?9,15,10,70,101325,0,0,300,9999,{},{},0,0,0,0\n", year, month, day, hour,
        beam, diffuse);
}

TEST(Epw, GivesSiteClockAndTheHourBeforeEachRecord) {
    const ReadWeather read =
        epw(std::string(kHead) + record(1999, 6, 21, 12, "500", "120") +
            record(1999, 6, 21, 24, "0", "0"));
    EXPECT_TRUE(read.faults.empty());
    EXPECT_EQ(read.file.site->latitude_deg, 51.97);
    EXPECT_EQ(read.file.site->longitude_deg, 5.67);
    EXPECT_EQ(read.file.utc_offset_hours, 1);
    ASSERT_EQ(read.file.records.size(), 2U);
    const WeatherRecord& noon = read.file.records[0];
    EXPECT_EQ(noon.start, (CivilTime{1999, 6, 21, 11, 0, 0, 1}));
    EXPECT_EQ(noon.seconds, 3600);
    EXPECT_EQ(noon.reading.beam_normal, 500);
    EXPECT_EQ(noon.reading.diffuse, 120);
    EXPECT_FALSE(noon.is_missing);
    EXPECT_EQ(noon.line, 4U);
    EXPECT_EQ(read.file.records[1].start.hour, 23);
}

TEST(Epw, NotesMissingValuesAndYearsThatAreMixed) {
    const ReadWeather read =
        epw(std::string(kHead) + record(1999, 1, 31, 12, "9999", "120") +
            record(1985, 2, 1, 12, "500", "99999"));
    EXPECT_TRUE(read.faults.empty());
    EXPECT_TRUE(read.file.records[0].is_missing);
    EXPECT_TRUE(read.file.records[1].is_missing);
    EXPECT_TRUE(read.file.is_typical_year);
}

TEST(Epw, ReadsSeveralRecordsAnHour) {
    std::string text = kHead;
    text.replace(text.find("1,1,Data"), 8, "1,4,Data");
    const std::string row = record(1999, 6, 21, 12, "500", "120");
    const auto at = [&](const char* minute) {
        std::string changed = row;
        return changed.replace(changed.find(",60,"), 4, fmt::format(",{},", minute));
    };
    const ReadWeather read = epw(text + at("15") + at("60"));
    EXPECT_TRUE(read.faults.empty());
    EXPECT_EQ(read.file.records[0].start, (CivilTime{1999, 6, 21, 11, 0, 0, 1}));
    EXPECT_EQ(read.file.records[1].start, (CivilTime{1999, 6, 21, 11, 45, 0, 1}));
    EXPECT_EQ(read.file.records[0].seconds, 900);
}

/// Records of every hour of some months, each with its year.
std::string months(const std::vector<std::pair<int, int>>& years_and_months) {
    std::string text;
    for (const auto& [year, month] : years_and_months) {
        for (int day = 1; day <= days_in_month(year, month); ++day) {
            for (int hour = 1; hour <= 24; ++hour) {
                text += record(year, month, day, hour, "0", "0");
            }
        }
    }
    return text;
}

TEST(Epw, RefusesRecordsThatAreThereTwiceOrOutOfOrder) {
    const std::string noon = record(2023, 6, 21, 12, "500", "100");
    const std::string one = record(2023, 6, 21, 13, "500", "100");
    EXPECT_TRUE(epw(kHead + noon + one).faults.empty());
    EXPECT_TRUE(mentions(
        epw(kHead + noon + noon + one).faults,
        "w.epw:5: the record of 2023-06-21T11:00+01:00 is repeated or out of order"));
    EXPECT_TRUE(mentions(epw(kHead + one + noon).faults, "w.epw:5: the record"));
    const std::string year = months({{1999, 12}, {1983, 1}, {1990, 2}});
    EXPECT_TRUE(epw(kHead + year).faults.empty()) << "a typical year from December on";
    const auto twice = epw(kHead + year + year).faults;
    ASSERT_EQ(twice.size(), 1U) << ::testing::PrintToString(twice);
    EXPECT_TRUE(mentions(twice, "more record"));
    const std::string same = months({{2023, 12}, {2023, 1}});
    EXPECT_EQ(epw(kHead + same).faults.size(), 1U) << "no typical year goes back within a year";
    const std::string summers = months({{1999, 8}, {2000, 6}});
    EXPECT_TRUE(epw(kHead + summers).faults.empty());
    EXPECT_FALSE(epw(kHead + summers).file.is_typical_year) << "two summers";
}

TEST(Epw, ReportsEveryBadRecord) {
    const ReadWeather read = epw(
        std::string(kHead) + record(1999, 2, 29, 1, "0", "0") + record(1999, 6, 21, 25, "0", "0") +
        record(1999, 6, 21, 1, "x", "0") + record(1999, 6, 21, 2, "-5", "0") + "1999,6,21,3\n");
    EXPECT_EQ(read.faults.size(), 5U);
    EXPECT_TRUE(mentions(read.faults, "w.epw:4"));
    EXPECT_TRUE(mentions(read.faults, "hour is 25"));
    EXPECT_TRUE(mentions(read.faults, "'x'"));
    EXPECT_TRUE(mentions(read.faults, "negative"));
    EXPECT_TRUE(mentions(read.faults, "a record of 4 fields"));
}

TEST(Epw, RefusesOtherFiles) {
    EXPECT_TRUE(mentions(epw("time,global\n").faults, "does not begin with LOCATION"));
    EXPECT_TRUE(mentions(epw("").faults, "contains no records"));
    EXPECT_TRUE(mentions(epw(kHead).faults, "contains no records"));
    EXPECT_FALSE(epw("LOCATION,x\n").faults.empty());
}

TEST(WeatherTable, ReadsItsColumnsByName) {
    const ReadWeather read =
        csv("# a station\ntime,wind,global,diffuse\n"
            "2024-06-21T12:00+01:00,3,600,150\n2024-06-21T12:30+01:00,3,650,160\n");
    EXPECT_TRUE(read.faults.empty());
    ASSERT_EQ(read.file.records.size(), 2U);
    EXPECT_EQ(read.file.records[0].start, (CivilTime{2024, 6, 21, 11, 30, 0, 1}));
    EXPECT_EQ(read.file.records[0].seconds, 1800);
    EXPECT_EQ(read.file.records[1].reading.global, 650);
    EXPECT_EQ(read.file.records[1].reading.diffuse, 160);
}

TEST(WeatherTable, FollowsTheNamesStampAndMarksThatAreStated) {
    WeatherColumns columns;
    columns.time = "when";
    columns.light = {{"global", "PAR in"}};
    columns.utc_offset_hours = -7;
    columns.stamp = WeatherColumns::Stamp::start;
    columns.missing.insert("bad");
    const ReadWeather read = csv(
        "when;PAR in\n2024-06-21 12:00;900\n2024-06-21 13:00;bad\n2024-06-21 14:00;\n", columns);
    EXPECT_TRUE(read.faults.empty());
    EXPECT_EQ(read.file.records[0].start, (CivilTime{2024, 6, 21, 12, 0, 0, -7}));
    EXPECT_EQ(read.file.records[0].reading.global, 900);
    EXPECT_FALSE(read.file.records[0].is_missing);
    EXPECT_TRUE(read.file.records[1].is_missing);
    EXPECT_TRUE(read.file.records[2].is_missing);
}

TEST(WeatherTable, TakesMarksOfMissingValuesHoweverTheyAreWritten) {
    WeatherColumns columns;
    columns.missing.insert("-99");
    const ReadWeather read =
        csv("time,global\n2024-06-21T12:00Z,-999.0\n2024-06-21T13:00Z,-9999.00\n"
            "2024-06-21T14:00Z,-99.0\n2024-06-21T15:00Z,99\n",
            columns);
    EXPECT_TRUE(read.faults.empty());
    ASSERT_EQ(read.file.records.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(read.file.records[i].is_missing, i < 3) << i;
    }
}

TEST(WeatherTable, TellsOfColumnsThatAreNotRead) {
    const auto warnings = [](const WeatherColumns& columns, const std::string& names) {
        Reporter reporter{"w.csv", {}, {}};
        static_cast<void>(read_weather_csv(
            "time," + names + "\n2024-06-21T12:00Z,500,100,0.2\n2024-06-21T13:00Z,500,100,0.2\n",
            columns, reporter));
        EXPECT_TRUE(reporter.faults.empty());
        std::string all;
        for (const Warning& warning : reporter.warnings) {
            all += warning.where + ": " + warning.text + "\n";
        }
        return all;
    };
    WeatherColumns global;
    global.light = {{"global", "global"}};
    EXPECT_EQ(
        warnings(global, "global,Diffuse,wind"),
        "w.csv:1: the column 'Diffuse' is not read: columns lists others and not this one\n");
    EXPECT_EQ(
        warnings({}, "global,diffuse,diffuse_fraction"),
        "w.csv:1: the column 'diffuse_fraction' is not read: other columns give direct and diffuse "
        "light\n");
    EXPECT_EQ(warnings({}, "global,diffuse,wind"), "");
}

TEST(WeatherTable, ReportsEveryBadRow) {
    const ReadWeather read =
        csv("time,global\n2024-06-21T12:00Z,600,7\nnoon,600\n2024-06-21T13:00Z,much\n"
            "2024-02-30T13:00Z,1\n2024-06-21T13:00,1\n2024-06-21T14:00Z,1\n");
    EXPECT_EQ(read.faults.size(), 5U);
    EXPECT_TRUE(mentions(read.faults, "w.csv:2: 3 fields (there are 2 columns)"));
    EXPECT_TRUE(mentions(read.faults, "'noon' is not a time"));
    EXPECT_TRUE(mentions(read.faults, "'much'"));
    EXPECT_TRUE(mentions(read.faults, "has no time zone"));
}

/// How a table of days of the year is read.
WeatherColumns columns_of_days() {
    WeatherColumns columns;
    columns.light = {{"global", "Rg"}, {"diffuse_fraction", "RdRg"}};
    columns.utc_offset_hours = 1;
    columns.year = 2006;
    return columns;
}

TEST(WeatherTable, TakesDaysOfTheYearAndDiffuseFractions) {
    const ReadWeather read =
        csv("DOY;Hour;Rg;RdRg;Group\n59;23;0;1;0\n59;24;-1;1;0\n60;1;0.5;0;0\n60;2;500;0.4;0\n",
            columns_of_days());
    EXPECT_TRUE(read.faults.empty()) << ::testing::PrintToString(read.faults);
    ASSERT_EQ(read.file.records.size(), 4U);
    EXPECT_EQ(read.file.records[0].start, (CivilTime{2006, 2, 28, 22, 0, 0, 1}));
    EXPECT_EQ(read.file.records[3].start, (CivilTime{2006, 3, 1, 1, 0, 0, 1}));
    EXPECT_EQ(read.file.records[3].seconds, 3600);
    EXPECT_EQ(read.file.records[3].reading.global, 500);
    EXPECT_EQ(read.file.records[3].reading.diffuse, 200);
    EXPECT_FALSE(read.file.records[1].reading.diffuse.has_value()) << "a part of no light";
}

TEST(WeatherTable, TakesAColumnOfYears) {
    WeatherColumns columns;
    columns.utc_offset_hours = 0;
    const ReadWeather read = csv("year,doy,hour,global\n2005,365,24,5\n2006,1,1,6\n", columns);
    EXPECT_TRUE(read.faults.empty()) << ::testing::PrintToString(read.faults);
    EXPECT_EQ(read.file.records[0].start, (CivilTime{2005, 12, 31, 23, 0, 0, 0}));
    EXPECT_EQ(read.file.records[1].start, (CivilTime{2006, 1, 1, 0, 0, 0, 0}));
}

TEST(WeatherTable, SaysWhatDaysOfTheYearLack) {
    const std::string rows = "\n1;1;0;1\n1;2;0;1\n";
    WeatherColumns columns = columns_of_days();
    columns.year.reset();
    EXPECT_TRUE(mentions(csv("DOY;Hour;Rg;RdRg" + rows, columns).faults, "the year is missing"));
    columns = columns_of_days();
    columns.utc_offset_hours.reset();
    EXPECT_TRUE(mentions(csv("DOY;Hour;Rg;RdRg" + rows, columns).faults, "the clock is unknown"));
    columns = columns_of_days();
    EXPECT_TRUE(mentions(
        csv("DOY;Hour;Rg;RdRg\n366;1;0;1\n", columns).faults, "w.csv:2: 2006 has no day 366"));
    EXPECT_TRUE(
        mentions(csv("DOY;Hour;Rg;RdRg\n1;25;0;1\n", columns).faults, "w.csv:2: the hour is '25'"));
    EXPECT_TRUE(mentions(
        csv("DOY;Hour;Rg;RdRg\n1;1;5;1.5\n", columns).faults, "diffuse_fraction is '1.5'"));
    columns.light = {{"diffuse_fraction", "RdRg"}};
    EXPECT_TRUE(mentions(csv("DOY;Hour;Rg;RdRg" + rows, columns).faults, "needs global alone"));
}

TEST(WeatherTable, RefusesColumnsThatAreThereTwice) {
    const std::string row = "\n2024-06-21T12:00Z,1,2\n2024-06-21T13:00Z,1,2\n";
    EXPECT_TRUE(mentions(
        csv("time,global,global" + row).faults, "w.csv:1: two columns are named 'global'"));
    EXPECT_TRUE(mentions(
        csv("time,GLOBAL,Global" + row).faults, "w.csv:1: two columns are named 'global'"));
    WeatherColumns same;
    same.light = {{"global", "Rg"}, {"diffuse", "Rg"}};
    EXPECT_TRUE(mentions(csv("time,Rg,x" + row, same).faults, "use the same column 'Rg'"));
    EXPECT_TRUE(csv("time,global,wind" + row).faults.empty());
}

TEST(WeatherTable, RefusesAmountsBeyondAnyLight) {
    EXPECT_TRUE(mentions(
        csv("time,global\n2024-06-21T12:00Z,1e308\n").faults, "w.csv:2: global is '1e308'"));
}

TEST(WeatherTable, TakesADateAloneForThatDay) {
    WeatherColumns columns;
    columns.utc_offset_hours = 1;
    const std::string rows = "time,global\n2024-06-12,12\n2024-06-13,13\n";
    const ReadWeather read = csv(rows, columns);
    EXPECT_TRUE(read.faults.empty()) << ::testing::PrintToString(read.faults);
    EXPECT_TRUE(read.warnings.empty()) << ::testing::PrintToString(read.warnings);
    EXPECT_EQ(read.file.records[0].start, (CivilTime{2024, 6, 12, 0, 0, 0, 1}));
    EXPECT_EQ(read.file.records[0].seconds, kSecondsADay);
    EXPECT_EQ(read.file.records[0].reading.global, 12);
    EXPECT_EQ(csv("time,global\n2024-06-12,12\n", columns).file.records[0].seconds, kSecondsADay);
    columns.stamp = WeatherColumns::Stamp::end;
    EXPECT_EQ(csv(rows, columns).file.records[0].start, (CivilTime{2024, 6, 11, 0, 0, 0, 1}))
        << "as stated";
}

/// A table of the hours of two days.
std::string hours_of_two_days(int first, int last) {
    std::string text = "day_of_year,hour,global\n";
    for (const int day : {172, 173}) {
        for (int hour = first; hour <= last; ++hour) {
            text += fmt::format("{},{},{}\n", day, hour, hour > 6 && hour < 19 ? 150 : 0);
        }
    }
    return text;
}

TEST(WeatherTable, AsksForTheStampWhereRowsSeemToBeginAtTheirTimes) {
    WeatherColumns columns;
    columns.utc_offset_hours = 1;
    columns.year = 2024;
    const auto warnings = [&](const std::string& text) { return csv(text, columns).warnings; };
    EXPECT_TRUE(mentions(
        warnings(hours_of_two_days(0, 23)),
        "w.csv:2: the rows go from 00:00 to 23:00, as if each were for the 60 minutes after its "
        "time, but it is used for those before; write stamp = \"start\", or stamp = \"end\" if "
        "that is right"));
    EXPECT_TRUE(warnings(hours_of_two_days(1, 24)).empty());
    EXPECT_TRUE(warnings(hours_of_two_days(8, 16)).empty()) << "it can't be told";
    const std::string middles =
        "time,global\n2024-06-12T00:30,0\n2024-06-12T01:30,0\n2024-06-12T23:30,0\n";
    EXPECT_TRUE(mentions(warnings(middles), "write stamp = \"middle\""));
    EXPECT_TRUE(mentions(
        warnings("time,global\n2024-06-12T00:00,9\n2024-06-13T00:00,0\n"), "stamp = \"start\""));
    columns.stamp = WeatherColumns::Stamp::end;
    EXPECT_TRUE(warnings(hours_of_two_days(0, 23)).empty()) << "as stated";
}

TEST(WeatherTable, WarnsOfRowsThatStandForMoreThanTheTimeBetweenThem) {
    WeatherColumns columns;
    columns.seconds = 3600;
    const std::string rows = "time,global\n2024-06-12T10:30Z,1\n2024-06-12T11:00Z,1\n";
    EXPECT_TRUE(mentions(csv(rows, columns).warnings, "rows are 30 minutes apart"));
    EXPECT_TRUE(csv(rows).warnings.empty());
}

TEST(WeatherTable, RefusesTimesThatGoBack) {
    const ReadWeather autumn =
        csv("time,global\n2024-10-27T02:30+02:00,1\n2024-10-27T02:45+02:00,1\n"
            "2024-10-27T02:15+02:00,1\n2024-10-27T02:15+02:00,1\n");
    EXPECT_TRUE(mentions(autumn.faults, "goes back in time"));
    EXPECT_TRUE(mentions(autumn.faults, "the same time again"));
    EXPECT_TRUE(mentions(
        csv("time,global\n2024-12-31T23:00Z,1\n2024-01-01T00:00Z,1\n").faults,
        "need a column year"));
    EXPECT_TRUE(
        csv("time,global\n2024-10-27T02:30+02:00,1\n2024-10-27T02:30+01:00,1\n").faults.empty())
        << "the hour that comes twice, told apart by its offset";
}

TEST(WeatherTable, SaysWhatItLacks) {
    EXPECT_TRUE(mentions(csv("").faults, "is empty"));
    EXPECT_TRUE(mentions(csv("date,global\n").faults, "no column 'time'"));
    EXPECT_TRUE(mentions(csv("time,wind\n").faults, "no column of light"));
    EXPECT_TRUE(mentions(csv("time,global\n").faults, "contains no readable rows"));
    EXPECT_TRUE(mentions(csv("time,global\n2024-06-21T12:00Z,5\n").faults, "a single row"));
    WeatherColumns typo;
    typo.light = {{"global", "globe"}};
    EXPECT_TRUE(
        mentions(csv("time,global\n2024-06-21T12:00Z,5\n", typo).faults, "did you mean 'global'"));
}

TEST(Fields, AreSplitWithQuotes) {
    EXPECT_EQ(
        split_fields("a,\"b,c\",,\"d\"\"e\"", ','),
        (std::vector<std::string>{"a", "b,c", "", "d\"e"}));
    EXPECT_EQ(split_fields("", ','), std::vector<std::string>{""});
}

}  // namespace
}  // namespace quasimc::test

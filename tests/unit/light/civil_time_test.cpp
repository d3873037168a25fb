#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "quasimc/source.h"

namespace quasimc::test {
namespace {

std::string faults_of(const CivilTime& time) {
    Faults faults;
    check_time(time, "time", faults);
    try {
        faults.throw_if_any();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

struct DatedDay {
    CivilTime time;
    double julian_day;
};

/// Reda and Andreas (2004), table A4.1, and Meeus (1998), chapter 7.
TEST(CivilTime, HasTheJulianDaysOfThePublishedTables) {
    const std::array<DatedDay, 7> table{
        {{{2000, 1, 1, 12}, 2451545.0},
         {{1999, 1, 1}, 2451179.5},
         {{1987, 1, 27}, 2446822.5},
         {{1987, 6, 19, 12}, 2446966.0},
         {{1988, 1, 27}, 2447187.5},
         {{1988, 6, 19, 12}, 2447332.0},
         {{1900, 1, 1}, 2415020.5}}};
    for (const DatedDay& row : table) {
        EXPECT_NEAR(julian_day(row.time), row.julian_day, 1e-9)
            << row.time.year << '-' << row.time.month << '-' << row.time.day;
        EXPECT_EQ(faults_of(row.time), "");
    }
}

TEST(CivilTime, CountsTimeZonesFromUtc) {
    const double noon = julian_day({2024, 6, 21, 12});
    EXPECT_NEAR(julian_day({2024, 6, 21, 14, 0, 0, 2}), noon, 1e-9);
    EXPECT_NEAR(julian_day({2024, 6, 21, 5, 0, 0, -7}), noon, 1e-9);
    EXPECT_NEAR(julian_day({2024, 6, 21, 17, 45, 0, 5.75}), noon, 1e-9);
    EXPECT_NEAR(julian_day({2024, 6, 22, 2, 0, 0, 14}), noon, 1e-9);
}

RC_GTEST_PROP(CivilTime, ComesBackFromItsJulianDay, ()) {
    CivilTime time;
    time.year = *rc::gen::inRange(kFirstYear, kLastYear + 1);
    time.month = *rc::gen::inRange(1, 13);
    time.day = *rc::gen::inRange(1, days_in_month(time.year, time.month) + 1);
    time.hour = *rc::gen::inRange(0, 24);
    time.minute = *rc::gen::inRange(0, 60);
    time.second = *rc::gen::inRange(0, 60);
    time.utc_offset_hours = *rc::gen::inRange(-14, 15);
    const CivilTime back = civil_time(julian_day(time), time.utc_offset_hours);
    CivilTime expected = time;
    // A double holds a Julian day to 0.04 ms.
    expected.second = back.second;
    RC_ASSERT(std::abs(time.second - back.second) < 2e-4);
    RC_ASSERT(back == expected);
}

TEST(CivilTime, KnowsLeapDays) {
    for (const int year : {2024, 2000, 1904}) {
        EXPECT_EQ(days_in_month(year, 2), 29) << year;
        EXPECT_EQ(faults_of({year, 2, 29}), "") << year;
    }
    for (const int year : {2023, 1900, 2100}) {
        EXPECT_NE(faults_of({year, 2, 29}).find("has 28 days"), std::string::npos) << year;
    }
    EXPECT_EQ(day_of_year({2024, 12, 31}), 366);
    EXPECT_EQ(day_of_year({2023, 12, 31}), 365);
    EXPECT_EQ(day_of_year({2024, 3, 1}), 61);
}

TEST(CivilTime, KnowsWhereLeapSecondsAre) {
    EXPECT_EQ(faults_of({2016, 12, 31, 23, 59, 60}), "");
    EXPECT_EQ(faults_of({2016, 12, 31, 23, 59, 60.5}), "");
    EXPECT_EQ(faults_of({2017, 1, 1, 0, 59, 60, 1}), "");
    EXPECT_EQ(faults_of({2016, 12, 31, 18, 59, 60, -5}), "");
    EXPECT_EQ(julian_day({2016, 12, 31, 23, 59, 60}), julian_day({2017, 1, 1}));
    for (const CivilTime& wrong :
         {CivilTime{2016, 12, 31, 23, 59, 61}, CivilTime{2016, 12, 31, 12, 0, 60},
          CivilTime{2016, 12, 30, 23, 59, 60}, CivilTime{2016, 12, 31, 23, 59, 60, 1},
          CivilTime{1960, 12, 31, 23, 59, 60}}) {
        EXPECT_NE(faults_of(wrong), "") << wrong.day << ' ' << wrong.second;
    }
}

TEST(CivilTime, RefusesWhatNoClockShows) {
    for (const CivilTime& wrong :
         {CivilTime{1899}, CivilTime{2101}, CivilTime{2024, 13}, CivilTime{2024, 0},
          CivilTime{2024, 4, 31}, CivilTime{2024, 4, 0}, CivilTime{2024, 4, 1, 24},
          CivilTime{2024, 4, 1, -1}, CivilTime{2024, 4, 1, 0, 60}, CivilTime{2024, 4, 1, 0, 0, -1},
          CivilTime{2024, 4, 1, 0, 0, NAN}, CivilTime{2024, 4, 1, 0, 0, 0, 14.5},
          CivilTime{2024, 4, 1, 0, 0, 0, -15}, CivilTime{2024, 4, 1, 0, 0, 0, NAN}}) {
        EXPECT_NE(faults_of(wrong), "");
    }
    EXPECT_NE(
        faults_of({2024, 4, 1, 0, 0, 0, 200}).find("its time zone is 200 h from UTC"),
        std::string::npos);
    EXPECT_NE(
        faults_of({1899}).find("year is 1899 (it must be from 1900 to 2100)"), std::string::npos);
    Faults faults;
    check_site({91, 181, 12000, -1, 200}, "site", faults);
    EXPECT_EQ(faults.size(), 5);
}

TEST(CivilTime, GoesOnOverTheEndsOfDaysAndYears) {
    EXPECT_EQ(later({2023, 12, 31, 23, 55, 0, 1}, 600), (CivilTime{2024, 1, 1, 0, 5, 0, 1}));
    EXPECT_EQ(later({2024, 3, 1, 0, 0, 0, -3}, -1), (CivilTime{2024, 2, 29, 23, 59, 59, -3}));
}

TEST(StandardPressure, FallsWithHeight) {
    // ISO 2533, tables 5 and 6.
    EXPECT_DOUBLE_EQ(standard_pressure_hpa(0), 1013.25);
    EXPECT_NEAR(standard_pressure_hpa(1000), 898.75, .02);
    EXPECT_NEAR(standard_pressure_hpa(3000), 701.09, .05);
}

/// Espenak and Meeus (2006), table of the years; the polynomials as other programs have them.
TEST(DeltaT, IsThatOfEspenakAndMeeus) {
    struct Row {
        int year, month;
        double seconds;
    };
    const std::array<Row, 9> table{
        {{1900, 6, -2.1171894e+00},
         {1950, 7, 2.9289261e+01},
         {1970, 8, 4.0824887e+01},
         {1985, 9, 5.4724581e+01},
         {1985, 2, 54.413442486},
         {1990, 10, 5.7426651e+01},
         {2000, 11, 6.4108015e+01},
         {2005, 12, 6.5038015e+01},
         {2050, 12, 9.4952955e+01}}};
    for (const Row& row : table) {
        EXPECT_NEAR(
            delta_t_seconds(CivilTime{row.year, row.month}), row.seconds, 1e-7 * row.seconds + 2e-3)
            << row.year;
    }
}

}  // namespace
}  // namespace quasimc::test

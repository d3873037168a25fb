#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "quasimc/source.h"

namespace quasimc::test {
namespace {

/// Seconds after midnight of the clock.
double seconds_of(const CivilTime& time) {
    return 3600 * time.hour + 60 * time.minute + time.second;
}
double clock(int hour, int minute, double second = 0) {
    return 3600 * hour + 60 * minute + second;
}

struct Day {
    Site site;
    CivilTime date;
    double sunrise, transit, sunset;
};

/// Reda and Andreas (2004): the example (transit and sunset are those of the eve, since the report
/// counts in days of Greenwich), table A6; NREL's calculator. To the second.
TEST(SunDay, RisesAndSetsAsInTheReport) {
    constexpr Site kGolden{39.742476, -105.1786, 1830.14};
    const std::array<Day, 4> table{
        {{{-35, 0}, {1996, 7, 5}, clock(7, 8, 15), clock(12, 4, 36), clock(17, 1, 4)},
         {{-35, 0}, {2004, 12, 4}, clock(4, 38, 57), clock(11, 50, 22), clock(19, 2, 3)},
         {{35, 0}, {1994, 1, 2}, clock(7, 8, 12), 0, clock(16, 59, 55)},
         {kGolden, {2015, 8, 2, 0, 0, 0, -7}, clock(5, 0, 27), clock(12, 6, 58), 0}}};
    for (const Day& row : table) {
        const SunDay day = sun_day(row.site, row.date, 65);
        ASSERT_EQ(day.kind, DayKind::ordinary);
        EXPECT_NEAR(seconds_of(*day.sunrise), row.sunrise, 1) << row.date.year;
        if (row.transit > 0) {
            EXPECT_NEAR(seconds_of(day.transit), row.transit, 1) << row.date.year;
        }
        if (row.sunset > 0) {
            EXPECT_NEAR(seconds_of(*day.sunset), row.sunset, 1) << row.date.year;
        }
    }
    EXPECT_NEAR(
        seconds_of(*sun_day(kGolden, {2003, 10, 17, 0, 0, 0, -7}, 67).sunrise), clock(6, 12, 43),
        1);
    EXPECT_NEAR(
        seconds_of(*sun_day(kGolden, {2003, 10, 16, 0, 0, 0, -7}, 67).sunset), clock(17, 20, 19),
        1);
}

/// Tables of the US Naval Observatory, to the minute.
TEST(SunDay, RisesAndSetsAsTheNavalObservatoryHasIt) {
    constexpr Site kColorado{39, -105};
    constexpr Site kBeijing{39.917, 116.383};
    const std::array<Day, 8> table{
        {{kColorado, {2015, 1, 2, 0, 0, 0, -7}, clock(7, 19), 0, clock(16, 49)},
         {kColorado, {2015, 4, 2, 0, 0, 0, -7}, clock(5, 43), 0, clock(18, 24)},
         {kColorado, {2015, 8, 2, 0, 0, 0, -7}, clock(5, 1), 0, clock(19, 10)},
         {kColorado, {2015, 12, 2, 0, 0, 0, -7}, clock(7, 1), 0, clock(16, 38)},
         {kBeijing, {2015, 1, 2, 0, 0, 0, 8}, clock(7, 36), 0, clock(17, 0)},
         {kBeijing, {2015, 4, 2, 0, 0, 0, 8}, clock(5, 58), 0, clock(18, 39)},
         {kBeijing, {2015, 8, 2, 0, 0, 0, 8}, clock(5, 13), 0, clock(19, 28)},
         {kBeijing, {2015, 12, 2, 0, 0, 0, 8}, clock(7, 17), 0, clock(16, 50)}}};
    for (const Day& row : table) {
        const SunDay day = sun_day(row.site, row.date);
        EXPECT_NEAR(seconds_of(*day.sunrise), row.sunrise, 31) << row.date.month;
        EXPECT_NEAR(seconds_of(*day.sunset), row.sunset, 31) << row.date.month;
    }
}

TEST(SunDay, HasNoRiseOnPolarDaysAndNights) {
    constexpr Site kTromso{69.65, 18.96};
    const SunDay summer = sun_day(kTromso, {2024, 6, 21, 0, 0, 0, 2});
    EXPECT_EQ(summer.kind, DayKind::polar_day);
    EXPECT_FALSE(summer.sunrise || summer.sunset);
    EXPECT_NEAR(summer.transit_elevation_deg, 90 - 69.65 + 23.44, .01);
    const SunDay winter = sun_day(kTromso, {2024, 12, 21, 0, 0, 0, 1});
    EXPECT_EQ(winter.kind, DayKind::polar_night);
    EXPECT_FALSE(winter.sunrise || winter.sunset);
    EXPECT_LT(winter.transit_elevation_deg, -3);
    EXPECT_EQ(sun_day(kTromso, {2024, 3, 20, 0, 0, 0, 1}).kind, DayKind::ordinary);
    EXPECT_EQ(sun_day({90, 0}, {2024, 6, 21}).kind, DayKind::polar_day);
    EXPECT_EQ(sun_day({-90, 0}, {2024, 6, 21}).kind, DayKind::polar_night);
}

/// In May a sun of the north sets after midnight, and belongs to the day before.
TEST(SunDay, MaySetAfterMidnight) {
    constexpr Site kBodo{67.28, 14.40};
    const SunDay day = sun_day(kBodo, {2024, 5, 27, 0, 0, 0, 2});
    ASSERT_TRUE(day.sunset);
    EXPECT_EQ(day.transit.day, 27);
    EXPECT_EQ(day.sunset->day, 28);
    EXPECT_EQ(day.sunset->hour, 0);
}

/// What rises is the sun of sun_position: 0.8333 degrees below the horizon but for its parallax.
TEST(SunDay, IsThatOfTheSunsPosition) {
    for (const double longitude : {-170.0, 0.0, 120.0}) {
        const Site site{48, longitude};
        const CivilTime date{2024, 2, 29, 0, 0, 0, nautical_utc_offset(longitude)};
        const SunDay day = sun_day(site, date);
        EXPECT_EQ(day.transit.day, 29);
        EXPECT_NEAR(sun_position(site, *day.sunrise).true_elevation_deg, -.8333, .004);
        EXPECT_NEAR(sun_position(site, *day.sunset).true_elevation_deg, -.8333, .004);
        const double azimuth = sun_position(site, day.transit).azimuth_deg;
        EXPECT_NEAR(azimuth, 180, .01);
    }
}

TEST(SimpleSun, FollowsTheRealOneWithinADegree) {
    for (int month = 1; month <= 12; ++month) {
        for (const double longitude : {-105.0, 10.0, 151.0}) {
            for (const int hour : {8, 12, 15}) {
                const double offset = nautical_utc_offset(longitude);
                const CivilTime time{2023, month, 15, hour, 0, 0, offset};
                const SunPosition real = sun_position({-27.5, longitude}, time);
                const SimpleSun simple =
                    simple_sun_position(-27.5, longitude, day_of_year(time), hour, offset);
                EXPECT_NEAR(simple.elevation_deg, real.true_elevation_deg, 1);
                const double turn = std::remainder(simple.azimuth_deg - real.azimuth_deg, 360);
                EXPECT_LT(std::abs(turn) * std::cos(real.elevation_deg * 3.14159 / 180), 1);
            }
        }
    }
}

TEST(SimpleSun, KnowsTimeZonesOf15Degrees) {
    EXPECT_EQ(nautical_utc_offset(-105.2), -7);
    EXPECT_EQ(nautical_utc_offset(7.4), 0);
    EXPECT_EQ(nautical_utc_offset(153), 10);
    // East of its meridian the sun is ahead of the clock.
    EXPECT_GT(
        simple_sun_position(0, 5, 81, 9, 0).elevation_deg,
        simple_sun_position(0, 0, 81, 9, 0).elevation_deg);
}

}  // namespace
}  // namespace quasimc::test

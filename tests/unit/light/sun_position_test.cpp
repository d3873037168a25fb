#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "quasimc/source.h"

namespace quasimc::test {
namespace {

/// Golden, Colorado: the site of the report's example.
constexpr Site kGolden{39.742476, -105.1786, 1830.14, 820, 11};
constexpr CivilTime kExample{2003, 10, 17, 12, 30, 30, -7};

/// Reda and Andreas (2004), table A5.1.
TEST(SunPosition, IsThatOfTheReportsExample) {
    const SunPosition sun = sun_position(kGolden, kExample, 67);
    EXPECT_NEAR(sun.zenith_deg(), 50.11162, 5e-6);
    EXPECT_NEAR(sun.azimuth_deg, 194.34024, 5e-6);
    EXPECT_NEAR(sun.true_elevation_deg, 39.872046, 1e-6);
    EXPECT_NEAR(sun.elevation_deg, 39.888378, 1e-6);
    EXPECT_NEAR(sun.distance_au, 0.9965422974, 1e-10);
    EXPECT_NEAR(sun.declination_deg, -9.31434, 5e-6);
    EXPECT_NEAR(sun.equation_of_time_min, 14.641503, 2e-5);
}

/// The same table's intermediate values.
TEST(SunPosition, PassesThroughTheReportsIntermediates) {
    const SunIntermediates at = sun_position(kGolden, kExample, 67).intermediates;
    EXPECT_NEAR(at.julian_day, 2452930.312847, 1e-6);
    EXPECT_NEAR(at.earth_longitude_deg, 24.0182616917, 1e-9);
    EXPECT_NEAR(at.earth_latitude_deg, -0.0001011219, 1e-9);
    EXPECT_NEAR(at.nutation_longitude_deg, -0.00399840, 5e-9);
    EXPECT_NEAR(at.nutation_obliquity_deg, 0.00166657, 5e-9);
    EXPECT_NEAR(at.obliquity_deg, 23.440465, 5e-7);
    EXPECT_NEAR(at.apparent_longitude_deg, 204.0085519281, 1e-9);
    EXPECT_NEAR(at.sidereal_time_deg, 318.511910, 1e-6);
    EXPECT_NEAR(at.right_ascension_deg, 202.227408, 1e-6);
    EXPECT_NEAR(at.declination_deg, -9.314340, 1e-6);
    EXPECT_NEAR(at.hour_angle_deg, 11.105902, 1e-5);
    EXPECT_NEAR(at.topocentric_right_ascension_deg, 202.227039, 1e-5);
    EXPECT_NEAR(at.topocentric_declination_deg, -9.316179, 1e-6);
    EXPECT_NEAR(at.topocentric_hour_angle_deg, 11.106271, 1e-5);
}

/// A day after the example, from the tests of pvlib (which do not give their delta T: 3 s make
/// 0.00003 degrees).
TEST(SunPosition, IsThatOfPvlibADayLater) {
    const SunPosition sun = sun_position(kGolden, {2003, 10, 18, 12, 30, 30, -7}, 67);
    EXPECT_NEAR(sun.zenith_deg(), 50.478260, 1e-5);
    EXPECT_NEAR(sun.azimuth_deg, 194.311132, 5e-5);
}

/// The Astronomical Almanac for 1992 (page C16) and 2013 (page C12): the sun at 0 h terrestrial
/// time, as cited in the tests of SunPy.
TEST(SunPosition, IsThatOfTheAstronomicalAlmanac) {
    constexpr double kSecond = 1.0 / 3600;
    const auto at_terrestrial_midnight = [](CivilTime date) {
        return sun_position({}, date, 0).intermediates;
    };
    const SunIntermediates october = at_terrestrial_midnight({1992, 10, 13});
    EXPECT_NEAR(october.apparent_longitude_deg, 199 + 54. / 60 + 21.56 * kSecond, kSecond);
    EXPECT_NEAR(october.right_ascension_deg, 15 * (13 + 13. / 60 + 30.75 * kSecond), kSecond);
    EXPECT_NEAR(october.declination_deg, -(7 + 47. / 60 + 1.7 * kSecond), kSecond);
    const SunIntermediates june = at_terrestrial_midnight({2013, 6, 17});
    EXPECT_NEAR(june.right_ascension_deg, 15 * (5 + 42. / 60 + 28.88 * kSecond), kSecond);
    EXPECT_NEAR(june.declination_deg, 23 + 22. / 60 + 27.8 * kSecond, kSecond);
}

/// A position of the sun, zenith angle without refraction.
struct Observation {
    CivilTime time;  ///< universal time
    double latitude, longitude, zenith, azimuth;
};

/// Topocentric positions of the US Naval Observatory's service, to one second of arc, as collected
/// for the tests of Pysolar.
const std::array<Observation, 28> kNavalObservatory{
    {{{2008, 4, 2, 5, 17, 18}, 13, 11, 89.40817, 84.93025},
     {{2008, 7, 22, 14, 51, 25}, 5, -12, 32.19897, 300.59919},
     {{2008, 1, 15, 0, 10, 14}, 61, 143, 87.43150, 146.11164},
     {{2008, 1, 7, 15, 52, 23}, 46, 162, 140.91947, 66.10317},
     {{2008, 3, 15, 22, 50, 12}, 24, -165, 26.08731, 169.43408},
     {{2008, 10, 17, 12, 48, 27}, 8, 64, 81.37636, 259.05144},
     {{2008, 12, 20, 4, 56, 26}, 19, 149, 60.15403, 226.96028},
     {{2008, 7, 13, 12, 30, 46}, 85, 61, 66.41928, 249.17942},
     {{2008, 2, 8, 6, 8, 8}, 39, -85, 155.97864, 8.30628},
     {{2008, 5, 4, 6, 7, 59}, 71, 107, 56.20000, 203.06478},
     {{2008, 5, 3, 0, 32, 21}, 32, 87, 76.87594, 79.48325},
     {{2008, 7, 11, 17, 51, 57}, 2, -119, 37.30442, 55.09769},
     {{2008, 9, 2, 14, 4, 47}, 69, -41, 61.68958, 169.08606},
     {{2008, 6, 15, 19, 40, 26}, 52, -124, 29.48339, 162.93711},
     {{2008, 11, 10, 17, 10, 42}, 9, -95, 29.48561, 153.46911},
     {{2008, 8, 5, 3, 53, 26}, 29, -57, 134.11900, 359.81578},
     {{2008, 3, 24, 20, 24, 25}, 2, -129, 4.41394, 92.30892},
     {{2008, 2, 21, 21, 19, 40}, 0, 175, 49.34781, 103.95178},
     {{2008, 3, 12, 13, 3, 45}, 88, -78, 92.17986, 115.60633},
     {{2008, 1, 12, 8, 1, 4}, 10, 55, 32.41061, 168.24883},
     {{2008, 7, 6, 19, 18, 5}, 82, -154, 61.96056, 131.52600},
     {{2008, 12, 26, 15, 21, 13}, 19, -40, 43.46978, 193.53272},
     {{2008, 6, 21, 13, 44, 45}, 0, -72, 50.64858, 59.04181},
     {{2008, 6, 3, 2, 33, 20}, 75, -47, 82.51453, 352.35192},
     {{2008, 12, 4, 1, 17, 42}, 76, -31, 126.06511, 349.54544},
     {{2008, 9, 22, 12, 7, 32}, 79, -123, 95.29489, 61.18636},
     {{2008, 8, 1, 6, 20, 21}, 3, -90, 158.80836, 9.27347},
     {{2008, 7, 3, 16, 16, 20}, 86, -164, 67.93131, 77.37864}}};

/// SPA is good to 0.0003 degrees, the observatory's numbers are rounded to 0.00028; near the zenith
/// and the nadir azimuths are that much less certain.
TEST(SunPosition, IsThatOfTheNavalObservatory) {
    constexpr double kDegrees = 3.14159265358979 / 180;
    for (const Observation& seen : kNavalObservatory) {
        const SunPosition sun = sun_position({seen.latitude, seen.longitude}, seen.time);
        SCOPED_TRACE(seen.zenith);
        EXPECT_NEAR(90 - sun.true_elevation_deg, seen.zenith, 4e-4);
        EXPECT_NEAR(sun.azimuth_deg, seen.azimuth, 4e-4 / std::sin(kDegrees * seen.zenith));
    }
}

/// A control: a minute late, or a degree east, is noticed.
TEST(SunPosition, DiffersAMinuteLaterAndADegreeFurtherEast) {
    const Observation& seen = kNavalObservatory[1];
    const Site site{seen.latitude, seen.longitude};
    EXPECT_GT(
        std::abs(90 - sun_position(site, later(seen.time, 60)).true_elevation_deg - seen.zenith),
        .1);
    EXPECT_GT(
        std::abs(
            90 - sun_position({seen.latitude, seen.longitude + 1}, seen.time).true_elevation_deg -
            seen.zenith),
        .5);
}

TEST(SunPosition, IsTheSameInEveryTimeZone) {
    const SunPosition utc = sun_position(kGolden, {2003, 10, 17, 19, 30, 30, 0}, 67);
    const SunPosition kathmandu = sun_position(kGolden, {2003, 10, 18, 1, 15, 30, 5.75}, 67);
    const SunPosition there = sun_position(kGolden, kExample, 67);
    EXPECT_NEAR(utc.azimuth_deg, there.azimuth_deg, 1e-6);
    EXPECT_NEAR(kathmandu.azimuth_deg, there.azimuth_deg, 1e-6);
    EXPECT_NEAR(kathmandu.elevation_deg, there.elevation_deg, 1e-6);
}

TEST(SunPosition, IsLiftedByTheAirOnlyWhereItIsSeen) {
    Site vacuum = kGolden;
    vacuum.pressure_hpa = 0;
    const SunPosition without = sun_position(vacuum, kExample, 67);
    EXPECT_EQ(without.elevation_deg, without.true_elevation_deg);
    const SunPosition night = sun_position(kGolden, {2003, 10, 17, 0, 0, 0, -7}, 67);
    EXPECT_LT(night.elevation_deg, -20);
    EXPECT_EQ(night.elevation_deg, night.true_elevation_deg);
    // Half a degree at the horizon, under a standard atmosphere.
    const CivilTime sunrise = *sun_day({0, 0}, {2024, 3, 20}).sunrise;
    const SunPosition rising = sun_position({0, 0}, later(sunrise, 30));
    EXPECT_NEAR(rising.elevation_deg - rising.true_elevation_deg, .56, .04);
}

TEST(SunPosition, IsDefinedAtThePolesAndOverhead) {
    for (const double latitude : {-90.0, 90.0}) {
        const SunPosition sun = sun_position({latitude, 0}, {2024, 6, 21, 12});
        EXPECT_NEAR(sun.true_elevation_deg, latitude > 0 ? 23.43 : -23.43, .01);
        EXPECT_TRUE(std::isfinite(sun.azimuth_deg));
    }
}

RC_GTEST_PROP(SunPosition, IsADirectionAtAnyTimeAndSite, ()) {
    const auto uniform = [](int low, int high) { return *rc::gen::inRange(low, high + 1); };
    const Site site{uniform(-900, 900) / 10.0, uniform(-1800, 1800) / 10.0};
    CivilTime time{
        uniform(kFirstYear, kLastYear), uniform(1, 12), uniform(1, 28), uniform(0, 23),
        uniform(0, 59)};
    const SunPosition sun = sun_position(site, time);
    RC_ASSERT(sun.azimuth_deg >= 0 && sun.azimuth_deg < 360);
    RC_ASSERT(std::abs(sun.true_elevation_deg) <= 90);
    RC_ASSERT(sun.elevation_deg >= sun.true_elevation_deg);
    RC_ASSERT(sun.elevation_deg - sun.true_elevation_deg < .7);
    RC_ASSERT(std::abs(sun.declination_deg) < 24.1);
    RC_ASSERT(std::abs(sun.distance_au - 1) < .02);
    RC_ASSERT(std::abs(sun.equation_of_time_min) < 22);
}

}  // namespace
}  // namespace quasimc::test

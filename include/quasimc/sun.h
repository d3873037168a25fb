#pragma once

// Where the sun stands: places on the Earth, civil time, and the position of the sun.

#include <optional>
#include <string_view>

#include "quasimc/error.h"

namespace quasimc {

inline constexpr double kSecondsADay = 86400;

/// A place on the Earth.
struct Place {
    double latitude_deg = 0;        ///< -90 to 90, north positive
    double longitude_deg = 0;       ///< -180 to 180, east positive
    double elevation_m = 0;         ///< above the sea
    double pressure_hpa = 1013.25;  ///< yearly mean; for refraction
    double temperature_c = 12;      ///< yearly mean; for refraction
};

/// A moment as clocks show it.
struct CivilTime {
    int year = 2000;  ///< 1900 to 2100
    int month = 1;    ///< 1 to 12
    int day = 1;      ///< from 1
    int hour = 0;     ///< 0 to 23
    int minute = 0;   ///< 0 to 59
    double second =
        0;  ///< 0 to below 60; to below 61 in a leap second, at the end of a month of UTC
    double utc_offset_hours = 0;  ///< clock time less UTC, -14 to 14; east of Greenwich positive

    friend bool operator==(const CivilTime&, const CivilTime&) = default;
};

inline constexpr int kFirstYear = 1900;
inline constexpr int kLastYear = 2100;

/// Reports what is wrong with a place. @param where  for the messages
void check_place(const Place& place, std::string_view where, Faults& faults);
/// Reports what is wrong with a time: fields out of range, days that no calendar has, leap seconds
/// where none can be.
void check_time(const CivilTime& time, std::string_view where, Faults& faults);

/// Pressure of the standard atmosphere [hPa] at a height above the sea (ISO 2533), for places whose
/// pressure is not known; -2000 to 11000 m.
[[nodiscard]] double standard_pressure_hpa(double elevation_m);

[[nodiscard]] int days_in_month(int year, int month);
/// 1 for the 1st of January.
[[nodiscard]] int day_of_year(const CivilTime& time);

/// Julian day of a moment: days of UTC since noon of 1 January -4712, fractions included. A leap
/// second has the Julian day of the second after it.
[[nodiscard]] double julian_day(const CivilTime& time);
/// The moment of a Julian day, as clocks of a time zone show it, to 0.1 ms.
[[nodiscard]] CivilTime civil_time(double julian_day, double utc_offset_hours);
/// A moment `seconds` later (earlier if negative), on the same clock.
[[nodiscard]] CivilTime later(const CivilTime& time, double seconds);

/// Terrestrial time less universal time [s]: polynomials of Espenak and Meeus (2006), "Five
/// millennium canon of solar eclipses"; some seconds off after 2006.
[[nodiscard]] double delta_t_seconds(const CivilTime& time);

/// What the solar position algorithm computes on its way, named as in Reda and Andreas (2004);
/// degrees unless named otherwise. For tests and for those who want to check.
struct SunIntermediates {
    double julian_day = 0;
    double earth_longitude_deg = 0;  ///< L, heliocentric
    double earth_latitude_deg = 0;   ///< B, heliocentric
    double nutation_longitude_deg = 0;
    double nutation_obliquity_deg = 0;
    double obliquity_deg = 0;           ///< of the ecliptic, true
    double apparent_longitude_deg = 0;  ///< lambda of the sun
    double sidereal_time_deg = 0;       ///< apparent, at Greenwich
    double right_ascension_deg = 0;     ///< geocentric
    double declination_deg = 0;         ///< geocentric
    double hour_angle_deg = 0;          ///< of the place, west positive, 0 to 360
    double topocentric_right_ascension_deg = 0;
    double topocentric_declination_deg = 0;
    double topocentric_hour_angle_deg = 0;
};

/// Where the sun stands, seen from a place.
struct SunPosition {
    double azimuth_deg = 0;           ///< clockwise from north, 0 to 360
    double elevation_deg = 0;         ///< above the horizon, as refracted by the air
    double true_elevation_deg = 0;    ///< without refraction
    double distance_au = 1;           ///< of the Earth's centre from the sun's, astronomical units
    double declination_deg = 0;       ///< geocentric
    double equation_of_time_min = 0;  ///< sundial less clock, -20 to 20
    SunIntermediates intermediates;

    [[nodiscard]] double zenith_deg() const { return 90 - elevation_deg; }
};

/// Position of the sun by the solar position algorithm of NREL, good to 0.0003 degrees.
///
/// Reda and Andreas (2004), "Solar position algorithm for solar radiation applications", Solar
/// Energy 76, 577-589; NREL/TP-560-34302 (revised 2008).
/// @param place, time  without faults (check_place, check_time)
/// @param delta_t_s  terrestrial less universal time [s]; default: delta_t_seconds(time)
[[nodiscard]] SunPosition sun_position(
    const Place& place, const CivilTime& time, std::optional<double> delta_t_s = std::nullopt);

/// What the sun does in the course of a day.
enum class DayKind {
    ordinary,     ///< it rises and sets
    polar_day,    ///< it does not set
    polar_night,  ///< it does not rise
};

/// Rise, transit and set of the sun that belong together: those around the transit of one day. In
/// high latitudes a sun that sets after midnight has a sunset of the next date.
struct SunDay {
    DayKind kind = DayKind::ordinary;
    CivilTime transit;                         ///< on the date asked for
    std::optional<CivilTime> sunrise, sunset;  ///< none unless kind is ordinary
    double transit_elevation_deg = 0;          ///< without refraction; below 0 in a polar night
};

/// The day of the sun on the date of `date` (its time of day does not count, its time zone does).
/// Rise and set: the sun's centre is 0.8333 degrees below the horizon, which stands for its radius
/// and the refraction there.
[[nodiscard]] SunDay sun_day(
    const Place& place, const CivilTime& date, std::optional<double> delta_t_s = std::nullopt);

/// The simple model that plant simulators know from the original program: declination, equation of
/// time (Iqbal 1983, as in Preetham et al. 1999) and hour angle.
struct SimpleSun {
    double azimuth_deg = 0;  ///< clockwise from north
    double elevation_deg = 0;
};
/// @param day_of_year  1 to 366
/// @param clock_hours  0 to 24, of a clock that is `utc_offset_hours` ahead of UTC
[[nodiscard]] SimpleSun simple_sun_position(
    double latitude_deg,
    double longitude_deg,
    double day_of_year,
    double clock_hours,
    double utc_offset_hours);
/// The time zone of a longitude: its nearest multiple of 15 degrees, in hours.
[[nodiscard]] double nautical_utc_offset(double longitude_deg);

}  // namespace quasimc

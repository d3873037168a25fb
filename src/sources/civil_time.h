#pragma once

#include <string_view>

#include "base/input_error.h"

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

/// A moment as clocks show it. Dates before 1582-10-15 are those of the Julian calendar; year 0 is
/// 1 BC.
struct CivilTime {
    int year = 2000;  ///< -2000 to 6000
    int month = 1;    ///< 1 to 12
    int day = 1;      ///< from 1
    int hour = 0;     ///< 0 to 23
    int minute = 0;   ///< 0 to 59
    double second =
        0;  ///< 0 to below 60; to below 61 in a leap second, at the end of a month of UTC
    double utc_offset_hours = 0;  ///< clock time less UTC, -14 to 14; east of Greenwich positive

    friend bool operator==(const CivilTime&, const CivilTime&) = default;
};

inline constexpr int kFirstYear = -2000;
inline constexpr int kLastYear = 6000;

/// Reports what is wrong with a place. @param where  for the messages
void check_place(const Place& place, std::string_view where, Faults& faults);
/// Reports what is wrong with a time: fields out of range, days that no calendar has, leap seconds
/// where none can be.
void check_time(const CivilTime& time, std::string_view where, Faults& faults);

/// Pressure of the standard atmosphere [hPa] at a height above the sea (ISO 2533), for places whose
/// pressure is not known; -2000 to 11000 m.
[[nodiscard]] double standard_pressure_hpa(double elevation_m);

[[nodiscard]] bool is_leap_year(int year);
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
/// millennium canon of solar eclipses"; some seconds off after 2006, hours before -500.
[[nodiscard]] double delta_t_seconds(double decimal_year);
[[nodiscard]] double delta_t_seconds(const CivilTime& time);

}  // namespace quasimc

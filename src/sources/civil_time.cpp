#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "quasimc/sun.h"

namespace quasimc {
namespace {

/// The first Julian day of the Gregorian calendar, 15 October 1582, 0 h.
constexpr double kGregorian = 2299160.5;
constexpr double kSecondsPerDay = 86400;

/// Whether a date is of the Gregorian calendar.
bool is_gregorian(int year, int month, int day) {
    return year > 1582 || (year == 1582 && (month > 10 || (month == 10 && day >= 15)));
}

/// Julian day of a date at 0 h (Meeus 1998, "Astronomical algorithms", chapter 7).
double julian_day_of_date(int year, int month, int day) {
    const double y = month <= 2 ? year - 1 : year;
    const double m = month <= 2 ? month + 12 : month;
    const double century = std::floor(y / 100);
    const double leap = is_gregorian(year, month, day) ? 2 - century + std::floor(century / 4) : 0;
    return std::floor(365.25 * (y + 4716)) + std::floor(30.6001 * (m + 1)) + day + leap - 1524.5;
}

/// The date of a Julian day that ends in .5 (Meeus 1998).
CivilTime date_of(double midnight) {
    const double z = midnight + 0.5;
    double a = z;
    if (midnight >= kGregorian) {
        const double alpha = std::floor((z - 1867216.25) / 36524.25);
        a = z + 1 + alpha - std::floor(alpha / 4);
    }
    const double b = a + 1524;
    const double c = std::floor((b - 122.1) / 365.25);
    const double d = std::floor(365.25 * c);
    const double e = std::floor((b - d) / 30.6001);
    CivilTime date;
    date.day = static_cast<int>(b - d - std::floor(30.6001 * e));
    date.month = static_cast<int>(e < 14 ? e - 1 : e - 13);
    date.year = static_cast<int>(date.month > 2 ? c - 4716 : c - 4715);
    return date;
}

/// Whether the minute of a time is the last of a month of UTC, which leap seconds lengthen.
bool ends_a_month_of_utc(const CivilTime& time) {
    CivilTime minute = time;
    minute.second = 0;
    const CivilTime utc = civil_time(julian_day(minute), 0);
    constexpr int kFirstLeapSecond = 1972;
    return utc.year >= kFirstLeapSecond && utc.hour == 23 && utc.minute == 59 &&
           utc.day == days_in_month(utc.year, utc.month);
}

/// Reports fields of a time.
class TimeChecker {
  public:
    TimeChecker(const CivilTime& time, std::string_view where, Faults& faults)
        : time_(time), where_(where), faults_(faults) {}

    void check() {
        const std::size_t before = faults_.size();
        whole("year", time_.year, kFirstYear, kLastYear);
        whole("month", time_.month, 1, 12);
        whole("hour", time_.hour, 0, 23);
        whole("minute", time_.minute, 0, 59);
        if (!(std::abs(time_.utc_offset_hours) <= 14)) {
            add(fmt::format("its time zone is {} h from UTC", shortest(time_.utc_offset_hours)),
                "clocks are at most 14 h from UTC", "give the offset in hours and minutes: +02:00");
        }
        if (faults_.size() == before) {
            check_day();
        }
        if (faults_.size() == before) {
            check_second();
        }
    }

  private:
    void add(std::string problem, std::string why, std::string suggestion = {}) {
        faults_.add(
            {std::string(where_), std::move(problem), std::move(why), std::move(suggestion)});
    }
    void whole(std::string_view name, int value, int low, int high) {
        if (value < low || value > high) {
            add(fmt::format("{} is {}", name, value),
                fmt::format("it must be from {} to {}", low, high));
        }
    }
    void check_day() {
        const int last = days_in_month(time_.year, time_.month);
        if (time_.day < 1 || time_.day > last) {
            add(fmt::format("day is {}", time_.day),
                fmt::format("month {} of {} has {} days", time_.month, time_.year, last));
        } else if (time_.year == 1582 && time_.month == 10 && time_.day > 4 && time_.day < 15) {
            add(fmt::format("there was no {} October 1582", time_.day),
                "the Gregorian calendar went from the 4th to the 15th");
        }
    }
    void check_second() {
        const bool is_leap = time_.second >= 60 && time_.second < 61;
        if (is_leap && !ends_a_month_of_utc(time_)) {
            add(fmt::format("second is {}", shortest(time_.second)),
                "a leap second comes after 23:59:59 UTC on the last day of a month, since 1972");
        } else if (!is_leap && !(time_.second >= 0 && time_.second < 60)) {
            add(fmt::format("second is {}", shortest(time_.second)),
                "it must be from 0 to below 60");
        }
    }

    const CivilTime& time_;
    std::string_view where_;
    Faults& faults_;
};

}  // namespace

void check_place(const Place& place, std::string_view where, Faults& faults) {
    const auto check = [&](std::string_view name, double value, double low, double high,
                           std::string_view unit) {
        if (!(value >= low && value <= high)) {
            faults.add(
                {std::string(where), fmt::format("{} is {}", name, shortest(value)),
                 fmt::format("it must be from {} to {}{}", low, high, unit), ""});
        }
    };
    check("latitude_deg", place.latitude_deg, -90, 90, ", north positive");
    check("longitude_deg", place.longitude_deg, -180, 180, ", east positive");
    check("elevation_m", place.elevation_m, -2000, 11000, "");
    check("pressure_hpa", place.pressure_hpa, 0, 2000, "");
    check("temperature_c", place.temperature_c, -100, 100, "");
}

void check_time(const CivilTime& time, std::string_view where, Faults& faults) {
    TimeChecker(time, where, faults).check();
}

double standard_pressure_hpa(double elevation_m) {
    return 1013.25 * std::pow(1 - 2.25577e-5 * elevation_m, 5.25588);
}

bool is_leap_year(int year) {
    return year % 4 == 0 && (!is_gregorian(year, 12, 31) || year % 100 != 0 || year % 400 == 0);
}

int days_in_month(int year, int month) {
    constexpr std::array kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return month == 2 && is_leap_year(year) ? 29 : kDays[static_cast<std::size_t>(month - 1)];
}

int day_of_year(const CivilTime& time) {
    return 1 + static_cast<int>(
                   julian_day_of_date(time.year, time.month, time.day) -
                   julian_day_of_date(time.year, 1, 1));
}

double julian_day(const CivilTime& time) {
    const double seconds =
        3600 * (time.hour - time.utc_offset_hours) + 60 * time.minute + time.second;
    return julian_day_of_date(time.year, time.month, time.day) + seconds / kSecondsPerDay;
}

CivilTime civil_time(double julian_day, double utc_offset_hours) {
    constexpr double kTicks = 10000;  // a second
    const double local = julian_day + utc_offset_hours / 24;
    double midnight = std::floor(local - 0.5) + 0.5;
    double ticks = std::round((local - midnight) * kSecondsPerDay * kTicks);
    if (ticks >= kSecondsPerDay * kTicks) {
        midnight += 1;
        ticks = 0;
    }
    CivilTime time = date_of(midnight);
    const double minutes = std::floor(ticks / (60 * kTicks));
    time.hour = static_cast<int>(minutes / 60);
    time.minute = static_cast<int>(minutes) % 60;
    time.second = (ticks - 60 * kTicks * minutes) / kTicks;
    time.utc_offset_hours = utc_offset_hours;
    return time;
}

CivilTime later(const CivilTime& time, double seconds) {
    return civil_time(julian_day(time) + seconds / kSecondsPerDay, time.utc_offset_hours);
}

}  // namespace quasimc

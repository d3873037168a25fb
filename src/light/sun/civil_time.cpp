#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "base/range.h"
#include "base/text.h"
#include "quasimc/source.h"

namespace quasimc {
namespace {

using std::chrono::sys_days;

/// Julian day of 1 January 1970, 0 h.
constexpr double kJulianDayOf1970 = 2440587.5;

std::chrono::year_month_day date_of(int year, int month, int day) {
    return {
        std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
        std::chrono::day(static_cast<unsigned>(day))};
}

/// Julian day of a date at 0 h.
double julian_day_of_date(const CivilTime& time) {
    const sys_days date = date_of(time.year, time.month, time.day);
    return kJulianDayOf1970 + static_cast<double>(date.time_since_epoch().count());
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

/// Reports values out of range.
struct RangeChecker {
    std::string_view where;
    Faults& faults;

    void check(std::string_view name, double value, Range range, std::string_view unit = "") const {
        if (!(value >= range.low && value <= range.high)) {
            faults.add(
                {std::string(where), fmt::format("{} is {}", name, shortest(value)),
                 fmt::format("it must be from {} to {}{}", range.low, range.high, unit), ""});
        }
    }
};

}  // namespace

void check_site(const Site& site, std::string_view where, Faults& faults) {
    const RangeChecker checker{where, faults};
    checker.check("latitude_deg", site.latitude_deg, {-90, 90}, ", north positive");
    checker.check("longitude_deg", site.longitude_deg, {-180, 180}, ", east positive");
    checker.check("elevation_m", site.elevation_m, {-2000, 11000});
    checker.check("pressure_hpa", site.pressure_hpa, {0, 2000});
    checker.check("temperature_c", site.temperature_c, {-100, 100});
}

void check_time(const CivilTime& time, std::string_view where, Faults& faults) {
    const std::size_t before = faults.size();
    const RangeChecker checker{where, faults};
    checker.check("year", time.year, {kFirstYear, kLastYear});
    checker.check("month", time.month, {1, 12});
    checker.check("hour", time.hour, {0, 23});
    checker.check("minute", time.minute, {0, 59});
    const auto add = [&](std::string problem, std::string why, std::string suggestion = {}) {
        faults.add({std::string(where), std::move(problem), std::move(why), std::move(suggestion)});
    };
    if (!(std::abs(time.utc_offset_hours) <= 14)) {
        add(fmt::format("its time zone is {} h from UTC", shortest(time.utc_offset_hours)),
            "clocks are at most 14 h from UTC", "give the offset in hours and minutes: +02:00");
    }
    if (faults.size() > before) {
        return;
    }
    const int last = days_in_month(time.year, time.month);
    const bool is_leap = time.second >= 60 && time.second < 61;
    if (time.day < 1 || time.day > last) {
        add(fmt::format("day is {}", time.day),
            fmt::format("month {} of {} has {} days", time.month, time.year, last));
    } else if (is_leap && !ends_a_month_of_utc(time)) {
        add(fmt::format("second is {}", shortest(time.second)),
            "a leap second comes after 23:59:59 UTC on the last day of a month, since 1972");
    } else if (!is_leap && !(time.second >= 0 && time.second < 60)) {
        add(fmt::format("second is {}", shortest(time.second)), "it must be from 0 to below 60");
    }
}

double standard_pressure_hpa(double elevation_m) {
    return 1013.25 * std::pow(1 - 2.25577e-5 * elevation_m, 5.25588);
}

int days_in_month(int year, int month) {
    const std::chrono::year_month_day_last last =
        std::chrono::year(year) / month / std::chrono::last;
    return static_cast<int>(static_cast<unsigned>(last.day()));
}

int day_of_year(const CivilTime& time) {
    const sys_days first = date_of(time.year, 1, 1);
    return 1 +
           static_cast<int>((sys_days(date_of(time.year, time.month, time.day)) - first).count());
}

double julian_day(const CivilTime& time) {
    const double seconds =
        3600 * (time.hour - time.utc_offset_hours) + 60 * time.minute + time.second;
    return julian_day_of_date(time) + seconds / kSecondsADay;
}

CivilTime civil_time(double julian_day, double utc_offset_hours) {
    constexpr double kTicks = 10000;  // a second
    const double local = julian_day + utc_offset_hours / 24;
    double midnight = std::floor(local - 0.5) + 0.5;
    double ticks = std::round((local - midnight) * kSecondsADay * kTicks);
    if (ticks >= kSecondsADay * kTicks) {
        midnight += 1;
        ticks = 0;
    }
    const std::chrono::days days(static_cast<int>(midnight - kJulianDayOf1970));
    const std::chrono::year_month_day date{sys_days(days)};
    CivilTime time;
    time.year = static_cast<int>(date.year());
    time.month = static_cast<int>(static_cast<unsigned>(date.month()));
    time.day = static_cast<int>(static_cast<unsigned>(date.day()));
    const double minutes = std::floor(ticks / (60 * kTicks));
    time.hour = static_cast<int>(minutes / 60);
    time.minute = static_cast<int>(minutes) % 60;
    time.second = (ticks - 60 * kTicks * minutes) / kTicks;
    time.utc_offset_hours = utc_offset_hours;
    return time;
}

CivilTime later(const CivilTime& time, double seconds) {
    return civil_time(julian_day(time) + seconds / kSecondsADay, time.utc_offset_hours);
}

}  // namespace quasimc

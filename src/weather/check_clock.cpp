#include "weather/check_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include <fmt/format.h>

#include "base/text.h"

namespace quasimc {
namespace {

/// The middle of a record's time, and whether the record has light.
struct LitTime {
    std::int64_t solar_day = 0;
    double day_of_year = 0, clock_hours = 0, utc_offset_hours = 0;
    double length_hours = 0;
    bool is_lit = false;
};

/// Hours per day in which light and sun disagree.
using Mismatch = std::map<std::int64_t, double>;

/// The global light of a reading, from any of its parts.
double amount_of(const Reading& reading) {
    return reading.global.value_or(
        reading.direct_horizontal.value_or(reading.beam_normal.value_or(0)) +
        reading.diffuse.value_or(0));
}

/// The records of a sample of days, spread over the whole file.
std::vector<LitTime> lit_times(const std::vector<WeatherRecord>& records, const Site& site) {
    constexpr double kLongest = 3 * 3600;
    constexpr double kDark = 0.005;  // of the brightest: sensors do not read exactly 0 at night
    constexpr std::int64_t kMaxDays = 60;
    const auto solar_day = [&](const CivilTime& time) {
        return static_cast<std::int64_t>(
            std::floor(julian_day(time) + site.longitude_deg / 360 + 0.5));
    };
    double brightest = 0;
    std::int64_t first = solar_day(records.front().start);
    std::int64_t last = first;  // the years of a typical year are in any order
    for (const WeatherRecord& record : records) {
        brightest = std::max(brightest, record.is_missing ? 0 : amount_of(record.reading));
        first = std::min(first, solar_day(record.start));
        last = std::max(last, solar_day(record.start));
    }
    const std::int64_t stride = 1 + (last - first) / kMaxDays;
    std::vector<LitTime> times;
    for (const WeatherRecord& record : records) {
        const CivilTime middle = later(record.start, 0.5 * record.seconds);
        const std::int64_t day = solar_day(middle);
        if (!record.is_missing && record.seconds <= kLongest && (day - first) % stride == 0) {
            times.push_back(
                {day, static_cast<double>(day_of_year(middle)),
                 middle.hour + middle.minute / 60.0 + middle.second / 3600, middle.utc_offset_hours,
                 record.seconds / 3600, amount_of(record.reading) > kDark * brightest});
        }
    }
    return times;
}

/// Removes days that are all light or all dark, which do not constrain the clock.
void remove_uniform_days(std::vector<LitTime>& times) {
    std::map<std::int64_t, std::pair<bool, bool>> seen;  // has light, has dark times
    for (const LitTime& time : times) {
        auto& [light, dark] = seen[time.solar_day];
        light = light || time.is_lit;
        dark = dark || !time.is_lit;
    }
    std::erase_if(times, [&](const LitTime& time) {
        const auto& [light, dark] = seen[time.solar_day];
        return !light || !dark;
    });
}

/// @param shift_hours  added to all clocks
Mismatch mismatch_of(
    const std::vector<LitTime>& times, double latitude, double longitude, double shift_hours) {
    constexpr double kSunriseDeg = -0.833;
    Mismatch days;
    for (const LitTime& time : times) {
        const SimpleSun sun = simple_sun_position(
            latitude, longitude, time.day_of_year, time.clock_hours + shift_hours,
            time.utc_offset_hours);
        const bool is_up = sun.elevation_deg > kSunriseDeg;
        days[time.solar_day] += is_up == time.is_lit ? 0 : time.length_hours;
    }
    return days;
}

double sum_of(const Mismatch& days) {
    double sum = 0;
    for (const auto& [day, hours] : days) {
        sum += hours;
    }
    return sum;
}

/// The shift of the clock with the smallest mismatch; the mean of several equal ones.
double best_shift(const std::vector<LitTime>& times, const Site& site) {
    constexpr int kSteps = 48;
    constexpr double kStepHours = 1 / 12.0;
    constexpr double kSame = 1e-6;
    double least = -1;
    double sum = 0;
    int count = 0;
    for (int i = -kSteps; i <= kSteps; ++i) {
        const double shift = i * kStepHours;
        const double off = sum_of(mismatch_of(times, site.latitude_deg, site.longitude_deg, shift));
        if (least < 0 || off < least - kSame) {
            least = off;
            sum = 0;
            count = 0;
        }
        if (off <= least + kSame) {
            sum += shift;
            ++count;
        }
    }
    return sum / count;
}

}  // namespace

std::optional<std::string> warning_of_clock(
    const std::vector<WeatherRecord>& records, const Site& site) {
    if (records.empty()) {
        return std::nullopt;
    }
    constexpr std::size_t kMinDays = 3;
    constexpr double kFarHours = 0.6;  // hourly records give sunrise and sunset to half an hour
    std::vector<LitTime> times = lit_times(records, site);
    remove_uniform_days(times);
    const auto at = [&](double latitude, double longitude, double shift) {
        return mismatch_of(times, latitude, longitude, shift);
    };
    const Mismatch given = at(site.latitude_deg, site.longitude_deg, 0);
    if (given.size() < kMinDays) {
        return std::nullopt;
    }
    const double shift = best_shift(times, site);
    const Mismatch shifted = at(site.latitude_deg, site.longitude_deg, shift);
    const auto better = std::count_if(given.begin(), given.end(), [&](const auto& day) {
        return shifted.at(day.first) < day.second;
    });
    const double gain = sum_of(given) - sum_of(shifted);
    const auto days = static_cast<double>(given.size());
    if (std::abs(shift) < kFarHours || gain < days || 2 * static_cast<double>(better) <= days) {
        return std::nullopt;
    }
    const bool is_exchanged =
        std::abs(site.longitude_deg) <= 90 &&
        sum_of(at(site.longitude_deg, site.latitude_deg, 0)) < sum_of(given) - 0.5 * gain;
    return fmt::format(
        "daylight is about {:.1f} hours {} the sun at latitude {}, longitude {} with a clock {} "
        "hours ahead of UTC: {}is the time zone, the longitude (east is positive) or stamp wrong?",
        std::abs(shift), shift > 0 ? "before" : "after", shortest(site.latitude_deg),
        shortest(site.longitude_deg), shortest(records.front().start.utc_offset_hours),
        is_exchanged ? "are latitude and longitude swapped, or " : "");
}

}  // namespace quasimc

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "text/line_scanner.h"
#include "text/numbers.h"
#include "weather/civil_time_text.h"
#include "weather/weather.h"

namespace quasimc {
namespace {

// Fields of a record, from 0 (EnergyPlus, Auxiliary Programs: weather converter).
constexpr std::size_t kYear = 0, kMonth = 1, kDay = 2, kHour = 3, kMinute = 4;
constexpr std::size_t kBeamNormal = 14, kDiffuse = 15;
constexpr std::size_t kMinFields = 16;
/// Values of light from this one on mean a missing value.
constexpr double kMissing = 9999;

/// Completes a year of two digits as POSIX does, 1969 to 2068; other years are unchanged.
int year_of_two_digits(int year) {
    constexpr int kFirst = 69;
    return year < 0 || year > 99 ? year : year + (year < kFirst ? 2000 : 1900);
}

/// Reads an EPW file line by line.
class EpwReader {
  public:
    EpwReader(std::string_view text, Reporter& reporter) : scanner_(text), reporter_(reporter) {}

    WeatherFile read() {
        while (scanner_.next() && !reporter_.is_full()) {
            const std::vector<std::string> fields = split_fields(scanner_.line(), ',');
            const std::string key(trimmed(fields[0]));
            if (scanner_.number() == 1 && key != "LOCATION") {
                reporter_.fault(1, "does not begin with LOCATION", "it is not an EPW file");
                return std::move(file_);
            }
            if (key == "LOCATION") {
                read_location(fields);
            } else if (key == "DATA PERIODS") {
                read_periods(fields);
            } else if (!key.empty() && parse_real(key)) {
                read_record(fields);
            }
        }
        if (file_.records.empty() && reporter_.faults.empty()) {
            reporter_.fault(scanner_.number(), "contains no records", "an EPW file has 8760 or so");
        }
        note_typical_year();
        check_order();
        if (short_years_ > 0) {
            reporter_.warn(
                fmt::format(
                    "{} times have years of two digits, read as 1969 to 2068", short_years_),
                first_short_year_);
        }
        return std::move(file_);
    }

  private:
    void fault(std::string problem, std::string why) {
        reporter_.fault(scanner_.number(), std::move(problem), std::move(why));
    }

    /// A number of a field; 0 after a fault.
    double number(const std::vector<std::string>& fields, std::size_t i, std::string_view what) {
        const auto value =
            i < fields.size() ? parse_real(trimmed(fields[i])) : std::optional<double>();
        if (!value || !std::isfinite(*value)) {
            fault(
                fmt::format(
                    "{} is {}", what, i < fields.size() ? shown(trimmed(fields[i])) : "missing"),
                fmt::format("field {} must be a number", i + 1));
            return 0;
        }
        return *value;
    }

    /// A whole number of a field; 0 after a fault.
    int whole(const std::vector<std::string>& fields, std::size_t i, std::string_view what) {
        const double value = number(fields, i, what);
        constexpr double kMost = 10000;
        if (value != std::floor(value) || std::abs(value) > kMost) {
            fault(fmt::format("{} is {}", what, shortest(value)), "it must be a whole number");
            return 0;
        }
        return static_cast<int>(value);
    }

    void read_location(const std::vector<std::string>& fields) {
        constexpr std::size_t kLatitude = 6, kLongitude = 7, kZone = 8, kElevation = 9;
        Site site;
        site.latitude_deg = number(fields, kLatitude, "latitude");
        site.longitude_deg = number(fields, kLongitude, "longitude");
        site.elevation_m = number(fields, kElevation, "elevation");
        offset_ = number(fields, kZone, "time zone");
        if (std::abs(offset_) > 14) {
            fault(fmt::format("time zone is {}", shortest(offset_)), "hours from UTC, -14 to 14");
            offset_ = 0;
        }
        site.pressure_hpa = standard_pressure_hpa(site.elevation_m);
        check_site(site, reporter_.where(scanner_.number()), reporter_.faults);
        file_.site = site;
        file_.utc_offset_hours = offset_;
    }

    void read_periods(const std::vector<std::string>& fields) {
        per_hour_ = number(fields, 2, "the number of records an hour");
        if (per_hour_ < 1 || per_hour_ > 60 || per_hour_ != std::floor(per_hour_)) {
            fault(fmt::format("{} records an hour", shortest(per_hour_)), "1 to 60");
            per_hour_ = 1;
        }
    }

    void read_record(const std::vector<std::string>& fields) {
        if (fields.size() < kMinFields) {
            fault(
                fmt::format("a record of {} fields", fields.size()),
                fmt::format("it must have at least {}", kMinFields));
            return;
        }
        const std::size_t before = reporter_.faults.size();
        CivilTime day;
        const int year = whole(fields, kYear, "year");
        day.year = year_of_two_digits(year);
        if (day.year != year) {
            first_short_year_ = short_years_++ == 0 ? scanner_.number() : first_short_year_;
        }
        day.month = whole(fields, kMonth, "month");
        day.day = whole(fields, kDay, "day");
        day.utc_offset_hours = offset_;
        check_time(day, reporter_.where(scanner_.number()), reporter_.faults);
        const double hour = number(fields, kHour, "hour");
        const double minute = number(fields, kMinute, "minute");
        if (hour < 1 || hour > 24) {
            fault(fmt::format("hour is {}", shortest(hour)), "1 to 24: the hour that ends then");
        }
        const double beam = number(fields, kBeamNormal, "beam normal irradiance");
        const double diffuse = number(fields, kDiffuse, "diffuse horizontal irradiance");
        if (beam < 0 || diffuse < 0) {
            fault("an irradiance is negative", "0 or more, 9999 where it is missing");
        }
        if (reporter_.faults.size() > before) {
            return;
        }
        const double length = 3600 / per_hour_;
        // With several records per hour, the minute is the end of each.
        const double end = per_hour_ == 1 ? 3600 : 60 * (minute == 0 ? 60 : minute);
        WeatherRecord record;
        record.start = later(day, 3600 * (hour - 1) + end - length);
        record.seconds = length;
        record.is_missing = beam >= kMissing || diffuse >= kMissing;
        record.reading.beam_normal = beam;
        record.reading.diffuse = diffuse;
        record.line = scanner_.number();
        file_.records.push_back(record);
    }

    /// Detects a typical year: the year changes within the calendar, as from January to February.
    void note_typical_year() {
        const auto date = [](const WeatherRecord& record) {
            return std::pair(record.start.month, record.start.day);
        };
        for (std::size_t i = 1; i < file_.records.size(); ++i) {
            const WeatherRecord& a = file_.records[i - 1];
            const WeatherRecord& b = file_.records[i];
            file_.is_typical_year =
                file_.is_typical_year || (a.start.year != b.start.year && date(b) > date(a));
        }
    }

    /// Checks that no time occurs twice, as its light would count twice. The records of a typical
    /// year cover the calendar once, from any month, and their years are ignored.
    void check_order() {
        constexpr double kSlack = 1, kYearSeconds = 366 * kSecondsADay;
        double turned = 0, first_begin = 0, end = 0;
        std::size_t count = 0;
        const WeatherRecord* first_bad = nullptr;
        for (std::size_t i = 0; i < file_.records.size(); ++i) {
            CivilTime time = file_.records[i].start;
            if (file_.is_typical_year) {
                const bool turns =
                    i > 0 && time.month == 1 && file_.records[i - 1].start.month == 12;
                turned += turns ? kYearSeconds : 0;
                time.year = 2000;
            }
            const double begin = kSecondsADay * julian_day(time) + turned;
            first_begin = i == 0 ? begin : first_begin;
            const bool is_again =
                file_.is_typical_year && begin > first_begin + kYearSeconds - kSlack;
            if (i > 0 && (begin < end - kSlack || is_again)) {
                first_bad = count++ == 0 ? &file_.records[i] : first_bad;
            }
            end = begin + file_.records[i].seconds;
        }
        if (count > 0) {
            reporter_.fault(
                first_bad->line,
                fmt::format(
                    "the record of {} is repeated or out of order",
                    civil_time_text(first_bad->start)),
                "a record must not begin before the one above it ends",
                count > 1 ? counted(count - 1, "more record") + " with this error" : "");
        }
    }

    LineScanner scanner_;
    Reporter& reporter_;
    WeatherFile file_;
    double offset_ = 0;
    double per_hour_ = 1;
    std::size_t short_years_ = 0;
    std::uint32_t first_short_year_ = 0;
};

}  // namespace

WeatherFile read_epw(std::string_view text, Reporter& reporter) {
    return EpwReader(text, reporter).read();
}

}  // namespace quasimc

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "base/checks.h"
#include "base/range.h"
#include "base/text.h"
#include "text/line_scanner.h"
#include "text/numbers.h"
#include "weather/civil_time_text.h"
#include "weather/weather.h"
#include "weather/weather_header.h"

namespace quasimc {
namespace {

/// Reads a table of weather row by row.
class TableOfWeather {
  public:
    TableOfWeather(std::string_view text, const WeatherColumns& columns, Reporter& reporter)
        : scanner_(text), columns_(columns), reporter_(reporter) {
        for (const std::string& word : columns.missing) {
            const auto number = parse_real(word);
            if (number && std::isfinite(*number)) {
                missing_numbers_.insert(*number);
            }
        }
    }

    WeatherFile read() {
        if (!read_header()) {
            return {};
        }
        while (next_line() && !reporter_.is_full()) {
            read_row(split_fields(scanner_.line(), separator_));
        }
        if (file_.records.empty()) {
            reporter_.fault(scanner_.number(), "contains no readable rows", "");
        }
        if (reporter_.faults.empty()) {
            set_times();
        }
        return std::move(file_);
    }

  private:
    /// Goes to the next line that is neither blank nor a comment.
    bool next_line() {
        while (scanner_.next()) {
            const std::string_view line = trimmed(scanner_.line());
            if (!line.empty() && line[0] != '#') {
                return true;
            }
        }
        return false;
    }

    bool read_header() {
        if (!next_line()) {
            reporter_.fault(1, "is empty", "a line of names and rows are needed");
            return false;
        }
        for (const char c : {'\t', ';', ','}) {
            separator_ = scanner_.line().find(c) != std::string_view::npos ? c : separator_;
        }
        std::vector<std::string> names = split_fields(scanner_.line(), separator_);
        for (std::string& name : names) {
            name = std::string(trimmed(name));
        }
        header_ = find_weather_columns(std::move(names), columns_, reporter_, scanner_.number());
        return reporter_.faults.empty();
    }

    /// The time of a row; empty after a fault.
    std::optional<CivilTime> time_of(const std::vector<std::string>& fields) {
        const std::string where = reporter_.where(scanner_.number());
        if (header_.time) {
            const std::string& text = fields[*header_.time];
            are_dates_ = are_dates_ && text.find(':') == std::string::npos;
            return parse_civil_time(text, columns_.utc_offset_hours, where, reporter_.faults);
        }
        are_dates_ = false;
        constexpr double kLastDay = 366, kLastHour = 24;
        const auto day = number(fields, *header_.day_of_year, "the day of the year", {1, kLastDay});
        const auto hour = number(fields, *header_.hour, "the hour", {0, kLastHour});
        const auto year = header_.year
                              ? number(fields, *header_.year, "the year", {kFirstYear, kLastYear})
                              : std::optional<double>(*columns_.year);
        if (!day || !hour || !year || !whole_number(*day) || !whole_number(*year)) {
            if (day && hour && year) {
                reporter_.fault(
                    scanner_.number(), "a fraction of a day or a year",
                    "these must be whole numbers");
            }
            return std::nullopt;
        }
        CivilTime first;
        first.year = static_cast<int>(*year);
        first.month = 1;
        first.day = 1;
        first.utc_offset_hours = *columns_.utc_offset_hours;
        const CivilTime time = later(first, (*day - 1) * kSecondsADay + *hour * 3600);
        if (later(first, (*day - 1) * kSecondsADay).year != first.year) {
            reporter_.fault(
                scanner_.number(), fmt::format("{} has no day {}", first.year, *day),
                "it is not a leap year", "check year");
            return std::nullopt;
        }
        return time;
    }

    /// A number of a field; empty after a fault.
    std::optional<double> number(
        const std::vector<std::string>& fields, std::size_t i, std::string_view what, Range range) {
        const std::string_view field = trimmed(fields[i]);
        const auto value = parse_real(field);
        if (!value || !(*value >= range.low && *value <= range.high)) {
            reporter_.fault(
                scanner_.number(), fmt::format("{} is {}", what, shown(field)),
                fmt::format("it must be a number from {} to {}", range.low, range.high));
            return std::nullopt;
        }
        return value;
    }

    void read_row(const std::vector<std::string>& fields) {
        if (fields.size() != header_.names.size()) {
            reporter_.fault(
                scanner_.number(), fmt::format("{} fields", fields.size()),
                fmt::format("there are {} columns", header_.names.size()));
            return;
        }
        WeatherRecord record;
        record.line = scanner_.number();
        const auto time = time_of(fields);
        if (!time) {
            return;
        }
        record.start = *time;
        std::optional<double> fraction;
        for (const auto& [part, i] : header_.light) {
            const std::string field(trimmed(fields[i]));
            const auto value = parse_real(field);
            if (columns_.missing.contains(field) || (value && missing_numbers_.contains(*value))) {
                record.is_missing = true;
                continue;
            }
            const double most = part == kDiffuseFraction ? 1 : TableReader::kLight.high;
            if (!value || !(std::abs(*value) <= most)) {
                reporter_.fault(
                    record.line, fmt::format("{} is {}", part, shown(field)),
                    fmt::format("it must be a number, {} at most", most),
                    field.find(',') == std::string::npos
                        ? "or name it in missing_values"
                        : "write numbers with a point, not with a comma");
                return;
            }
            std::optional<double>* const given =
                part == kDiffuseFraction ? &fraction : part_of(record.reading, part);
            ENSURE(given != nullptr);
            *given = *value;
        }
        // A fraction of zero light is ignored.
        if (fraction && record.reading.global.value_or(0) > 0) {
            record.reading.diffuse = *fraction * *record.reading.global;
        }
        file_.records.push_back(record);
    }

    /// The shortest time between rows. Reports rows that are not in temporal order.
    double shortest_step() {
        double step = std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i < file_.records.size(); ++i) {
            const double apart = seconds_between(i - 1, i);
            if (apart < 0.5) {
                constexpr double kNearlyAYear = 300 * kSecondsADay;
                reporter_.fault(
                    file_.records[i].line,
                    apart < -0.5 ? "goes back in time" : "the same time again",
                    "rows must be in the order of time",
                    apart < -kNearlyAYear ? "several years need a column year"
                                          : "with summer time, each time needs an offset from UTC");
            }
            step = std::min(step, apart);
        }
        return step;
    }

    /// Finds the duration of rows, and sets the times to their beginnings.
    void set_times() {
        const double apart = shortest_step();
        // A date alone means the whole day.
        const double step = columns_.seconds > 0 ? columns_.seconds
                            : are_dates_         ? std::min(apart, kSecondsADay)
                                                 : apart;
        if (!std::isfinite(step)) {
            reporter_.fault(
                file_.records[0].line, "a single row", "its duration is unknown",
                "give step_minutes");
            return;
        }
        warn_of_overlaps(apart, step);
        if (!columns_.stamp && !are_dates_) {
            warn_of_stamp(step);
        }
        const auto usual = are_dates_ ? WeatherColumns::Stamp::start : WeatherColumns::Stamp::end;
        const WeatherColumns::Stamp stamp = columns_.stamp.value_or(usual);
        const double before = stamp == WeatherColumns::Stamp::start    ? 0
                              : stamp == WeatherColumns::Stamp::middle ? 0.5
                                                                       : 1;
        for (WeatherRecord& record : file_.records) {
            record.seconds = std::round(step);
            record.start = later(record.start, -before * record.seconds);
        }
    }

    /// Warns of rows that are longer than the distance to the next: their common light counts
    /// twice.
    void warn_of_overlaps(double apart, double step) {
        constexpr double kSlack = 1;  // second
        if (apart < step - kSlack) {
            reporter_.warn(
                fmt::format(
                    "rows are {} minutes apart and last {} minutes each: light of overlapping "
                    "times counts twice",
                    shortest(std::round(apart) / 60), shortest(step / 60)),
                file_.records[0].line);
        }
    }

    /// Warns of a wrong `stamp`: in whole days of rows, the first and last times of day show
    /// whether times are beginnings, middles or ends of steps.
    void warn_of_stamp(double step) {
        const CivilTime& first = file_.records.front().start;
        const CivilTime& last = file_.records.back().start;
        // Number of the two that fit times at a fraction `part` of a step.
        const auto fitting = [&](double part) {
            const auto is_at = [&](const CivilTime& time, double seconds) {
                const double off = 3600 * time.hour + 60 * time.minute + time.second - seconds;
                return std::abs(std::remainder(off, kSecondsADay)) < 1 ? 1 : 0;
            };
            return is_at(first, part * step) + is_at(last, (part - 1) * step);
        };
        const int end = fitting(1);
        for (const auto& [part, name, side] :
             {std::tuple(0.0, "start", "after"), std::tuple(0.5, "middle", "around")}) {
            if (fitting(part) > 0 && fitting(part) >= end) {
                reporter_.warn(
                    fmt::format(
                        "the rows go from {:02d}:{:02d} to {:02d}:{:02d}, as if each were for the "
                        "{} minutes {} its time, but it is used for those before; write stamp = "
                        "\"{}\", or stamp = \"end\" if that is right",
                        first.hour, first.minute, last.hour, last.minute,
                        shortest(std::round(step / 60)), side, name),
                    file_.records[0].line);
                return;
            }
        }
    }

    [[nodiscard]] double seconds_between(std::size_t a, std::size_t b) const {
        return kSecondsADay *
               (julian_day(file_.records[b].start) - julian_day(file_.records[a].start));
    }

    LineScanner scanner_;
    const WeatherColumns& columns_;
    std::set<double> missing_numbers_;  // in any notation
    Reporter& reporter_;
    char separator_ = ',';
    WeatherHeader header_;
    WeatherFile file_;
    bool are_dates_ = true;  // whether all times so far are dates
};

}  // namespace

std::vector<std::string> split_fields(std::string_view line, char separator) {
    std::vector<std::string> fields(1);
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += line[++i];
        } else if (c == '"') {
            is_quoted = !is_quoted;
        } else if (c == separator && !is_quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    return fields;
}

WeatherFile read_weather_csv(
    std::string_view text, const WeatherColumns& columns, Reporter& reporter) {
    return TableOfWeather(text, columns, reporter).read();
}

}  // namespace quasimc

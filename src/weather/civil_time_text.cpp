#include "weather/civil_time_text.h"

#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Parses a text from left to right.
class Cursor {
  public:
    explicit Cursor(std::string_view text) : rest_(text) {}

    /// The number of the next digits and the characters of `more`; empty if there is none.
    std::optional<double> number(std::string_view more = "") {
        std::size_t n = 0;
        while (n < rest_.size() && (std::isdigit(static_cast<unsigned char>(rest_[n])) != 0 ||
                                    more.find(rest_[n]) != std::string_view::npos)) {
            ++n;
        }
        const auto value = parse_real(rest_.substr(0, n));
        rest_.remove_prefix(n);
        return value;
    }
    /// Skips the next character if it is one of these; returns whether it was.
    bool skip(std::string_view any_of) {
        const bool found = !rest_.empty() && any_of.find(rest_[0]) != std::string_view::npos;
        rest_.remove_prefix(found ? 1 : 0);
        return found;
    }
    [[nodiscard]] char peek() const { return rest_.empty() ? '\0' : rest_[0]; }
    [[nodiscard]] bool at_end() const { return rest_.empty(); }

  private:
    std::string_view rest_;
};

bool read_date(Cursor& cursor, CivilTime& time) {
    const auto year = cursor.number();
    const bool first = cursor.skip("-");
    const auto month = cursor.number();
    const bool second = cursor.skip("-");
    const auto day = cursor.number();
    const bool is_date = year && month && day && first && second;
    if (!is_date || *year >= 1e6 || *month >= 100 || *day >= 100) {
        return false;
    }
    time.year = static_cast<int>(*year);
    time.month = static_cast<int>(*month);
    time.day = static_cast<int>(*day);
    return true;
}

bool read_clock(Cursor& cursor, CivilTime& time) {
    const auto hour = cursor.number();
    const bool colon = cursor.skip(":");
    const auto minute = cursor.number();
    if (!hour || !colon || !minute || *hour >= 100 || *minute >= 100) {
        return false;
    }
    time.hour = static_cast<int>(*hour);
    time.minute = static_cast<int>(*minute);
    if (cursor.skip(":")) {
        const auto second = cursor.number(".");
        time.second = second.value_or(0);
        return second.has_value();
    }
    return true;
}

/// "Z", "+02:00", "-0330", "+2" or nothing. Returns false otherwise.
bool read_offset(Cursor& cursor, std::optional<double>& offset) {
    if (cursor.skip("Zz")) {
        offset = 0;
        return cursor.at_end();
    }
    if (cursor.at_end()) {
        return true;
    }
    const bool is_west = cursor.peek() == '-';
    if (!cursor.skip("+-")) {
        return false;
    }
    std::optional<double> hours = cursor.number();
    double minutes = 0;
    if (hours && cursor.skip(":")) {
        const auto given = cursor.number();
        hours = given ? hours : std::nullopt;
        minutes = given.value_or(0);
    } else if (hours && *hours >= 100) {
        minutes = std::fmod(*hours, 100);
        hours = std::floor(*hours / 100);
    }
    if (!hours || minutes >= 60 || !cursor.at_end()) {
        return false;
    }
    offset = (is_west ? -1 : 1) * (*hours + minutes / 60);
    return true;
}

}  // namespace

std::optional<CivilTime> parse_civil_time(
    std::string_view text,
    std::optional<double> utc_offset_hours,
    std::string_view where,
    Faults& faults,
    OffsetKey key) {
    CivilTime time;
    Cursor cursor(trimmed(text));
    std::optional<double> offset = utc_offset_hours;
    bool good = read_date(cursor, time);
    if (good && cursor.skip("Tt ")) {
        good = read_clock(cursor, time) && read_offset(cursor, offset);
    }
    if (!good || !cursor.at_end()) {
        faults.add(
            {std::string(where), shown(text) + " is not a time", "",
             "write it as 2024-06-21T12:00+02:00"});
        return std::nullopt;
    }
    if (!offset) {
        faults.add(
            {std::string(where), shown(text) + " has no time zone", "clocks differ between sites",
             key == OffsetKey::none
                 ? "add the offset to UTC, +02:00 or Z"
                 : "add the offset to UTC, +02:00 or Z, or give utc_offset_hours"});
        return std::nullopt;
    }
    time.utc_offset_hours = *offset;
    const bool is_midnight = time.hour == 24 && time.minute == 0 && time.second == 0;
    time.hour = is_midnight ? 0 : time.hour;
    Faults own;
    check_time(time, where, own);
    if (!own.empty()) {
        faults.add(own);
        return std::nullopt;
    }
    return is_midnight ? later(time, kSecondsADay) : time;
}

std::string date_text(const CivilTime& time) {
    return fmt::format("{:04d}-{:02d}-{:02d}", time.year, time.month, time.day);
}

std::string civil_time_text(const CivilTime& time) {
    // Computed times are rounded to the second.
    const int second = static_cast<int>(std::lround(time.second));
    const int offset = static_cast<int>(std::lround(60 * std::abs(time.utc_offset_hours)));
    const CivilTime shown_time =
        second == 60 && time.second < 60 ? later(time, 60 - time.second + 0.001) : time;
    std::string text =
        fmt::format("{}T{:02d}:{:02d}", date_text(shown_time), shown_time.hour, shown_time.minute);
    if (second != 0 && (second != 60 || time.second >= 60)) {
        text += fmt::format(":{:02d}", second);
    }
    return text +
           fmt::format(
               "{}{:02d}:{:02d}", time.utc_offset_hours < 0 ? '-' : '+', offset / 60, offset % 60);
}

}  // namespace quasimc

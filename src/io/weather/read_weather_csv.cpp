#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/text.h"
#include "io/line_scanner.h"
#include "io/numbers.h"
#include "io/runfile/civil_time_text.h"
#include "io/weather/weather.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 4> kReadingNames{
    "global", "direct_horizontal", "beam_normal", "diffuse"};

/// Reads a table of weather row by row.
class TableOfWeather {
  public:
    TableOfWeather(std::string_view text, const WeatherColumns& columns, Reporter& reporter)
        : scanner_(text), columns_(columns), reporter_(reporter) {}

    WeatherFile read() {
        if (!read_header()) {
            return {};
        }
        while (next_line() && !reporter_.is_full()) {
            read_row(split_fields(scanner_.line(), separator_));
        }
        if (file_.records.empty()) {
            reporter_.fault(scanner_.number(), "holds no rows that can be read", "");
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
        names_ = split_fields(scanner_.line(), separator_);
        for (std::string& name : names_) {
            name = std::string(trimmed(name));
        }
        time_ = column(columns_.time);
        for (const auto& [part, name] : columns_.light) {
            light_[part] = column(name);
        }
        if (columns_.light.empty()) {
            for (const std::string_view part : kReadingNames) {
                const auto found = std::find(names_.begin(), names_.end(), part);
                if (found != names_.end()) {
                    light_[std::string(part)] = static_cast<std::size_t>(found - names_.begin());
                }
            }
        }
        if (light_.empty()) {
            reporter_.fault(
                scanner_.number(), "no column of light",
                "one is named global, direct_horizontal, beam_normal or diffuse",
                "name the columns: columns = { global = \"...\" }");
        }
        return reporter_.faults.empty();
    }

    std::size_t column(const std::string& name) {
        const auto found = std::find(names_.begin(), names_.end(), name);
        if (found == names_.end()) {
            const std::vector<std::string_view> names(names_.begin(), names_.end());
            reporter_.fault(
                scanner_.number(), fmt::format("no column '{}'", name), "",
                did_you_mean(name, names));
        }
        return static_cast<std::size_t>(found - names_.begin());
    }

    void read_row(const std::vector<std::string>& fields) {
        if (fields.size() != names_.size()) {
            reporter_.fault(
                scanner_.number(), fmt::format("{} fields", fields.size()),
                fmt::format("there are {} columns", names_.size()));
            return;
        }
        WeatherRecord record;
        record.line = scanner_.number();
        const auto time = parse_civil_time(
            fields[time_], columns_.utc_offset_hours, reporter_.place(record.line),
            reporter_.faults);
        if (!time) {
            return;
        }
        record.start = *time;
        for (const auto& [part, i] : light_) {
            const std::string field(trimmed(fields[i]));
            if (columns_.missing.contains(field)) {
                record.is_missing = true;
                continue;
            }
            const auto value = parse_real(field);
            if (!value || !std::isfinite(*value)) {
                reporter_.fault(
                    record.line, fmt::format("{} is {}", part, shown(field)), "it must be a number",
                    "or name it in missing_values");
                return;
            }
            *part_of(record.reading, part) = *value;
        }
        file_.records.push_back(record);
    }

    /// Finds the step, and moves the times to the beginnings.
    void set_times() {
        double step = std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i < file_.records.size(); ++i) {
            const double apart = seconds_between(i - 1, i);
            if (apart < 0.5) {
                reporter_.fault(
                    file_.records[i].line,
                    apart < -0.5 ? "goes back in time" : "the same time again",
                    "rows are in the order of time",
                    "clocks that change in autumn need an offset to UTC in each time");
            }
            step = std::min(step, apart);
        }
        if (columns_.seconds > 0) {
            step = columns_.seconds;
        }
        if (!std::isfinite(step)) {
            reporter_.fault(
                file_.records[0].line, "a single row", "it can't be told how long it stands for",
                "give step_minutes");
            return;
        }
        const double before = columns_.stamp == WeatherColumns::Stamp::start    ? 0
                              : columns_.stamp == WeatherColumns::Stamp::middle ? 0.5
                                                                                : 1;
        for (WeatherRecord& record : file_.records) {
            record.seconds = std::round(step);
            record.start = later(record.start, -before * record.seconds);
        }
    }

    [[nodiscard]] double seconds_between(std::size_t a, std::size_t b) const {
        return kSecondsADay *
               (julian_day(file_.records[b].start) - julian_day(file_.records[a].start));
    }

    LineScanner scanner_;
    const WeatherColumns& columns_;
    Reporter& reporter_;
    char separator_ = ',';
    std::vector<std::string> names_;
    std::size_t time_ = 0;
    std::map<std::string, std::size_t> light_;
    WeatherFile file_;
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

std::optional<double>* part_of(Reading& reading, std::string_view name) {
    const std::array parts{
        &reading.global, &reading.direct_horizontal, &reading.beam_normal, &reading.diffuse};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (kReadingNames[i] == name) {
            return parts[i];
        }
    }
    return nullptr;
}

std::span<const std::string_view> reading_names() {
    return kReadingNames;
}

WeatherFile read_weather_csv(
    std::string_view text, const WeatherColumns& columns, Reporter& reporter) {
    return TableOfWeather(text, columns, reporter).read();
}

}  // namespace quasimc

#include "weather/weather_header.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 5> kLightNames{
    "global", "direct_horizontal", "beam_normal", "diffuse", kDiffuseFraction};
/// Names of the parts of a reading.
constexpr std::span<const std::string_view, 4> kReadingNames = std::span(kLightNames).first<4>();

/// Searches the names of columns.
class ColumnFinder {
  public:
    ColumnFinder(
        std::vector<std::string> names,
        const WeatherColumns& columns,
        Reporter& reporter,
        std::uint32_t line)
        : columns_(columns), reporter_(reporter), line_(line) {
        header_.names = std::move(names);
    }

    WeatherHeader find() {
        find_time_columns();
        find_light_columns();
        return std::move(header_);
    }

  private:
    void find_time_columns() {
        const bool has_day = !columns_.day_of_year.empty() || !columns_.hour.empty();
        if (!columns_.time.empty()) {
            header_.time = column(columns_.time);
            return;
        }
        header_.time = has_day ? std::nullopt : usual({"time"});
        if (header_.time) {
            return;
        }
        const auto stated_or_usual = [&](const std::string& name,
                                         std::initializer_list<std::string_view> usual_names) {
            return name.empty() ? usual(usual_names) : column(name);
        };
        header_.day_of_year = stated_or_usual(columns_.day_of_year, {"day_of_year", "doy"});
        header_.hour = stated_or_usual(columns_.hour, {"hour"});
        header_.year = stated_or_usual(columns_.year_column, {"year"});
        if (!reporter_.faults.empty()) {
            return;
        }
        if (!header_.day_of_year || !header_.hour) {
            reporter_.fault(
                line_, "no column 'time', nor day_of_year and hour",
                "a column time, or day_of_year (or DOY) and hour, is needed",
                "name the columns: columns = { time = \"...\" }");
        } else if (!header_.year && !columns_.year) {
            reporter_.fault(
                line_, "the year is missing", "the file has days of the year", "give year = 2006");
        } else if (!columns_.utc_offset_hours) {
            reporter_.fault(
                line_, "the clock is unknown", "the file has hours without an offset from UTC",
                "give utc_offset_hours");
        }
    }

    void find_light_columns() {
        for (const auto& [part, name] : columns_.light) {
            add_light(part, column(name));
        }
        if (columns_.light.empty()) {
            for (const std::string_view part : kReadingNames) {
                add_light(part, usual({part}));
            }
            if (header_.light.size() == 1 && header_.light.contains("global")) {
                add_light(kDiffuseFraction, usual({kDiffuseFraction}));
            }
        }
        warn_of_unread();
        if (header_.light.empty() && reporter_.faults.empty()) {
            reporter_.fault(
                line_, "no column of light",
                "a column global, direct_horizontal, beam_normal or diffuse is needed",
                "name the columns: columns = { global = \"...\" }");
        }
        const bool has_fraction = header_.light.contains(kDiffuseFraction);
        if (has_fraction && (!header_.light.contains("global") || header_.light.size() > 2)) {
            reporter_.fault(
                line_, "a diffuse fraction needs global alone", "it is a part of the global light");
        }
    }

    /// Warns of unread columns of light: if some are named, no others are read, nor is global light
    /// where its parts are given.
    void warn_of_unread() {
        for (std::size_t i = 0; i < header_.names.size(); ++i) {
            const auto is_read = std::any_of(
                header_.light.begin(), header_.light.end(),
                [&](const auto& column) { return column.second == i; });
            const std::string name = lower_case(header_.names[i]);
            if (!is_read &&
                std::find(kLightNames.begin(), kLightNames.end(), name) != kLightNames.end()) {
                reporter_.warn(
                    fmt::format(
                        "the column {} is not read: {}", shown(header_.names[i]),
                        columns_.light.empty() ? "other columns give direct and diffuse light"
                                               : "columns lists others and not this one"),
                    line_);
            }
        }
    }

    void add_light(std::string_view part, std::optional<std::size_t> i) {
        if (!i) {
            return;
        }
        for (const auto& [other, k] : header_.light) {
            if (k == *i) {
                reporter_.fault(
                    line_,
                    fmt::format(
                        "{} and {} use the same column '{}'", other, part, header_.names[*i]),
                    "each needs its own");
            }
        }
        header_.light[std::string(part)] = *i;
    }

    /// The column with one of these names, in any case; empty if there is none.
    std::optional<std::size_t> usual(std::initializer_list<std::string_view> usual_names) {
        for (const std::string_view wanted : usual_names) {
            const auto is_wanted = [&](const std::string& name) {
                return lower_case(name) == wanted;
            };
            if (const auto found = only(wanted, is_wanted, "they differ only in case")) {
                return found;
            }
        }
        return std::nullopt;
    }

    /// The only column with such a name, or empty; a second one is a fault.
    template <typename IsNamed>
    std::optional<std::size_t> only(
        std::string_view called, const IsNamed& is_named, const char* why) {
        const auto& names = header_.names;
        const auto found = std::find_if(names.begin(), names.end(), is_named);
        if (found == names.end()) {
            return std::nullopt;
        }
        if (std::any_of(found + 1, names.end(), is_named)) {
            reporter_.fault(
                line_, fmt::format("two columns are named {}", shown(called)), why,
                "rename one of them");
        }
        return static_cast<std::size_t>(found - names.begin());
    }

    /// The column named by a key; empty after a fault.
    std::optional<std::size_t> column(const std::string& name) {
        const auto found = only(
            name, [&](const std::string& other) { return other == name; },
            "it is unclear which one is meant");
        if (!found) {
            const std::vector<std::string_view> names(header_.names.begin(), header_.names.end());
            reporter_.fault(
                line_, fmt::format("no column '{}'", name), "", did_you_mean(name, names));
        }
        return found;
    }

    const WeatherColumns& columns_;
    Reporter& reporter_;
    std::uint32_t line_;
    WeatherHeader header_;
};

}  // namespace

WeatherHeader find_weather_columns(
    std::vector<std::string> names,
    const WeatherColumns& columns,
    Reporter& reporter,
    std::uint32_t line) {
    return ColumnFinder(std::move(names), columns, reporter, line).find();
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

std::span<const std::string_view> weather_light_names() {
    return kLightNames;
}

}  // namespace quasimc

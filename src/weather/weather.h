#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "light/daylight/hour_light.h"
#include "quasimc/source.h"
#include "text/table_reader.h"

namespace quasimc {

/// A record of a weather file.
struct WeatherRecord {
    CivilTime start;
    double seconds = 0;
    Reading reading;
    bool is_missing = false;  ///< a value that other records have is missing
    std::uint32_t line = 0;
};

/// A weather file.
struct WeatherFile {
    std::optional<Site> site;                ///< if the file gives it
    std::optional<double> utc_offset_hours;  ///< offset of its clock
    /// Whether its months are from different years (a typical year), so that the year is ignored.
    bool is_typical_year = false;
    std::vector<WeatherRecord> records;  ///< in temporal order
};

/// Reads EnergyPlus weather (EPW): beam normal and diffuse horizontal irradiance, W m-2. Records
/// cover the time before their hour, in local standard time. Faults go to the reporter.
[[nodiscard]] WeatherFile read_epw(std::string_view text, Reporter& reporter);

/// Format of a table of weather.
struct WeatherColumns {
    /// Position of a row's time within its interval.
    enum class Stamp { start, middle, end };

    /// Name of the column of times; "": "time" or, without it, day of year and hour.
    std::string time;
    /// Names of the columns that together give the time; "": their usual names.
    std::string day_of_year, hour, year_column;
    std::optional<int> year;  ///< year of files without a column of years
    /// Column names of "global", "direct_horizontal", "beam_normal", "diffuse", "diffuse_fraction"
    /// (of global).
    std::map<std::string, std::string, std::less<>> light;
    std::optional<double> utc_offset_hours;  ///< offset of times without one
    /// Empty: the end, but the beginning for dates without a time.
    std::optional<Stamp> stamp;
    double seconds = 0;  ///< duration of a row; 0: the step of the rows
    std::set<std::string, std::less<>> missing{"", "NA", "NaN", "nan", "-9999", "-999"};
};

/// Reads a table (CSV, separated by commas, semicolons or tabs) with a line of names.
[[nodiscard]] WeatherFile read_weather_csv(
    std::string_view text, const WeatherColumns& columns, Reporter& reporter);

/// The fields of a line of a table; quotes as in RFC 4180.
[[nodiscard]] std::vector<std::string> split_fields(std::string_view line, char separator);

/// The part of a reading with a name, or null.
[[nodiscard]] std::optional<double>* part_of(Reading& reading, std::string_view name);
/// The names of the parts.
[[nodiscard]] std::span<const std::string_view> reading_names();
/// Names of the quantities of columns: the parts, and the diffuse fraction.
[[nodiscard]] std::span<const std::string_view> weather_light_names();

}  // namespace quasimc

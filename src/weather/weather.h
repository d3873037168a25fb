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

/// The light of a time, as a weather file has it.
struct WeatherRecord {
    CivilTime start;
    double seconds = 0;
    Reading reading;
    bool is_missing = false;  ///< some of what the file gives elsewhere is not known here
    std::uint32_t line = 0;
};

/// A weather file.
struct WeatherFile {
    std::optional<Site> site;                ///< if the file tells it
    std::optional<double> utc_offset_hours;  ///< of its clock
    /// Whether its months are of different years (a typical year), so that only month, day and
    /// hour count.
    bool is_typical_year = false;
    std::vector<WeatherRecord> records;  ///< in the order of time
};

/// Reads EnergyPlus weather (EPW): beam normal and diffuse horizontal irradiance, W m-2. Records
/// stand for the time before their hour, in local standard time.
/// What is wrong goes to the reporter.
[[nodiscard]] WeatherFile read_epw(std::string_view text, Reporter& reporter);

/// How a table of weather is to be read.
struct WeatherColumns {
    /// Where the time of a row lies in the time it stands for.
    enum class Stamp { start, middle, end };

    /// Of the column of times; "": "time", or if there is none day of year and hour.
    std::string time;
    /// Of the columns that tell the time together; "": as they are usually called.
    std::string day_of_year, hour, year_column;
    std::optional<int> year;  ///< of files without a column of years
    /// "global", "direct_horizontal", "beam_normal", "diffuse", "diffuse_fraction" (of global): the
    /// names of their columns.
    std::map<std::string, std::string, std::less<>> light;
    std::optional<double> utc_offset_hours;  ///< of times without one
    /// Nothing: the end; of dates without a clock the beginning.
    std::optional<Stamp> stamp;
    double seconds = 0;  ///< that a row stands for; 0: the step of the rows
    std::set<std::string, std::less<>> missing{"", "NA", "NaN", "nan", "-9999", "-999"};
};

/// Reads a table (CSV, separated by commas, semicolons or tabs) with a line of names.
[[nodiscard]] WeatherFile read_weather_csv(
    std::string_view text, const WeatherColumns& columns, Reporter& reporter);

/// The fields of a line of a table; quotes as in RFC 4180.
[[nodiscard]] std::vector<std::string> split_fields(std::string_view line, char separator);

/// The part of a reading by its name, or null.
[[nodiscard]] std::optional<double>* part_of(Reading& reading, std::string_view name);
/// The names of the parts.
[[nodiscard]] std::span<const std::string_view> reading_names();
/// The names of what columns of a table may hold: the parts, and the diffuse fraction.
[[nodiscard]] std::span<const std::string_view> weather_light_names();

}  // namespace quasimc

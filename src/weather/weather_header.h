#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "weather/weather.h"

namespace quasimc {

/// What columns a table of weather has, from 0.
struct WeatherHeader {
    std::vector<std::string> names;
    std::optional<std::size_t> time;                        ///< or else:
    std::optional<std::size_t> day_of_year, hour, year;     ///< the year may be stated elsewhere
    std::map<std::string, std::size_t, std::less<>> light;  ///< by weather_light_names()
};

inline constexpr std::string_view kDiffuseFraction = "diffuse_fraction";

/// Finds the columns that are stated, or else those of the usual names. What is missing or there
/// twice goes to the reporter.
/// @param line  of the names, for messages
[[nodiscard]] WeatherHeader find_weather_columns(
    std::vector<std::string> names,
    const WeatherColumns& columns,
    Reporter& reporter,
    std::uint32_t line);

}  // namespace quasimc

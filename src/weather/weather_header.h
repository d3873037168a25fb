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

/// Indices of the columns of a weather table, from 0.
struct WeatherHeader {
    std::vector<std::string> names;
    std::optional<std::size_t> time;                        ///< or else these:
    std::optional<std::size_t> day_of_year, hour, year;     ///< the year may be given elsewhere
    std::map<std::string, std::size_t, std::less<>> light;  ///< by weather_light_names()
};

inline constexpr std::string_view kDiffuseFraction = "diffuse_fraction";

/// Finds the named columns, or else those with the usual names. Reports missing and repeated ones.
/// @param line  of the names, for messages
[[nodiscard]] WeatherHeader find_weather_columns(
    std::vector<std::string> names,
    const WeatherColumns& columns,
    Reporter& reporter,
    std::uint32_t line);

}  // namespace quasimc

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "weather/weather.h"

namespace quasimc {

/// Compares the hours with light to those with the sun up, over the days of the records. Clouds
/// never darken an hour altogether, so the comparison does not depend on the weather.
/// @returns  a warning if another clock fits most of the days better, by more than half an hour;
///     nothing for fewer than three days, and for days without night or without light
[[nodiscard]] std::optional<std::string> warning_of_clock(
    const std::vector<WeatherRecord>& records, const Site& site);

}  // namespace quasimc

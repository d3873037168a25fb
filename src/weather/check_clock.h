#pragma once

#include <optional>
#include <string>
#include <vector>

#include "weather/weather.h"

namespace quasimc {

/// Compares the hours with light with those with the sun above the horizon. Clouds never remove all
/// light, so the comparison does not depend on the weather.
/// @returns  a warning if a clock that differs by more than half an hour fits most days better;
///     empty for fewer than three days, and for days without night or without light
[[nodiscard]] std::optional<std::string> warning_of_clock(
    const std::vector<WeatherRecord>& records, const Site& site);

}  // namespace quasimc

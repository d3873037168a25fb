#pragma once

#include <string>

#include "quasimc/result.h"
#include "scene/scene.h"

namespace quasimc {

/// The unit of an irradiance times an area: "W" for "W m-2" and "m", "W m-2 cm2" for "W m-2" and
/// "cm".
[[nodiscard]] std::string flux_unit(
    const std::string& irradiance_unit, const std::string& length_unit);

/// The unit of a quantity in a band.
[[nodiscard]] std::string unit_of(
    const QuantityEntry& quantity, const Band& band, const std::string& length_unit);

}  // namespace quasimc

#pragma once

#include <string>

#include "quasimc/result.h"
#include "scene/scene.h"

namespace quasimc {

/// A unit of flux that has a name, and how much of it the product of the unit of irradiance and a
/// square unit of length is.
struct FluxUnit {
    double factor = 1;
    std::string name;
};

/// "W" and 1 for "W m-2" and "m", "W" and 1e-4 for "W m-2" and "cm", "lm" and 1 for "lx" and "m". A
/// unit of area that is not known stays: "W m-2 voxel2" and 1.
[[nodiscard]] FluxUnit named_flux_unit(
    const std::string& irradiance_unit, const std::string& length_unit);

/// The unit of an irradiance times an area in one text, in which UDUNITS reads a factor: "W" for
/// "W m-2" and "m", "1e-4 W" for "W m-2" and "cm".
[[nodiscard]] std::string flux_unit(
    const std::string& irradiance_unit, const std::string& length_unit);

/// The unit of a quantity in a band.
[[nodiscard]] std::string unit_of(
    const QuantityEntry& quantity, const Band& band, const std::string& length_unit);

}  // namespace quasimc

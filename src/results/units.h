#pragma once

#include <string>

#include "quasimc/result.h"
#include "scene/scene.h"

namespace quasimc {

/// A named unit of flux, and its factor to the product of the unit of irradiance and a square unit
/// of length.
struct FluxUnit {
    double factor = 1;
    std::string name;
};

/// "W" and 1 for "W m-2" and "m", "W" and 1e-4 for "W m-2" and "cm", "lm" and 1 for "lx" and "m".
/// An unknown unit of area stays: "W m-2 voxel2" and 1.
[[nodiscard]] FluxUnit named_flux_unit(
    const std::string& irradiance_unit, const std::string& length_unit);

/// The unit of an irradiance times an area as text, with a factor that UDUNITS reads: "W" for "W
/// m-2" and "m", "1e-4 W" for "W m-2" and "cm".
[[nodiscard]] std::string flux_unit(
    const std::string& irradiance_unit, const std::string& length_unit);

/// A unit summed over time: "J m-2" for "W m-2", "mol m-2" for "umol m-2 s-1", "lx s" for "lx".
struct SummedUnit {
    std::string name;
    double factor = 1;  ///< from unit x s
};
[[nodiscard]] SummedUnit summed_unit(const std::string& unit);

/// The unit of a quantity in a band.
[[nodiscard]] std::string unit_of(
    const QuantityEntry& quantity, const Band& band, const std::string& length_unit);

}  // namespace quasimc

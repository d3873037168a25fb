#pragma once

#include <array>
#include <cstddef>

#include "quasimc/result.h"

namespace quasimc {

/// A quantity is made of parts of the light that falls on an organ: by side, and by whether it came
/// straight from the sources.
struct LightParts {
    bool upper = true, lower = true;
    bool direct = true, scattered = true;
    bool suns = true;          ///< direct light includes that of suns
    bool is_absorbed = false;  ///< the absorbed part
};

/// All light that falls on an organ.
inline constexpr LightParts kIncidentLight;

/// A quantity as results, tables of values, JSON, NetCDF, C and Python have it, and its parts.
struct QuantityRow {
    QuantityEntry entry;
    LightParts parts;
};

/// THE TABLE of quantities.
inline constexpr std::array<QuantityRow, kQuantities> kQuantityRows{{
    {{Quantity::absorbed_flux, "absorbed_flux", "light absorbed by the organ", true},
     {.is_absorbed = true}},
    {{Quantity::absorbed_flux_density, "absorbed_flux_density", "light absorbed per one-sided area",
      false},
     {.is_absorbed = true}},
    {{Quantity::incident_upper, "incident_upper", "light on the upper side per area", false},
     {.lower = false}},
    {{Quantity::incident_lower, "incident_lower", "light on the lower side per area", false},
     {.upper = false}},
    {{Quantity::incident_direct, "incident_direct",
      "light on both sides straight from sun, sky and lamps, per area", false},
     {.scattered = false}},
    {{Quantity::incident_scattered, "incident_scattered",
      "light on both sides that other surfaces scattered, per area", false},
     {.direct = false}},
}};

/// The parts that a quantity is made of.
[[nodiscard]] constexpr const LightParts& parts_of(Quantity quantity) {
    return kQuantityRows[static_cast<std::size_t>(quantity)].parts;
}

}  // namespace quasimc

#pragma once

// The light of the sunlit and of the shaded part of organs.

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "quasimc/sums.h"

namespace quasimc {

/// Quantities of the sunlit and the shaded part of organs and groups: docs/theory/
/// sunlit-and-shaded.md. Light is per one-sided area of the part.
enum class SunShadeQuantity {
    incident_upper_direct,  ///< straight from sun, sky and lamps / all area
    incident_lower_direct,
    sunlit_fraction_upper,  ///< fraction of the area whose upper side is lit by a sun
    sunlit_fraction_lower,
    incident_upper_sunlit,  ///< light on the upper side, where a sun lights it
    incident_upper_shaded,  ///< light on the upper side without that straight from suns
    incident_lower_sunlit,
    incident_lower_shaded,
    absorbed_flux_density_sunlit,  ///< absorbed where a sun lights either side
    absorbed_flux_density_shaded,
};
inline constexpr std::size_t kSunShadeQuantities = 10;

/// The light of an organ that a quantity is made of, and the area which it is related to.
enum class SunShadePart {
    direct,    ///< straight from sources, of all area
    fraction,  ///< the sunlit fraction of the area, the same in each band
    sunlit,    ///< light per sunlit area
    shaded,    ///< light per shaded area
};
/// The surface of an organ whose light counts.
enum class SunShadeSurface { upper, lower, absorbed_by_both };

/// One row of the table of quantities.
struct SunShadeEntry {
    SunShadeQuantity quantity;
    std::string_view name;     ///< "sunlit_fraction_upper"
    std::string_view of_sums;  ///< its name in sums over time: "sunlit_hours_upper"
    std::string_view summary;  ///< one line for the manual
    SunShadePart part;
    SunShadeSurface surface;

    [[nodiscard]] constexpr bool has_bands() const { return part != SunShadePart::fraction; }
};
[[nodiscard]] const std::array<SunShadeEntry, kSunShadeQuantities>& sun_shade_table();

/// The light of the sunlit and the shaded part of organs, or of groups: estimates.
///
/// The sunlit part of a side receives the light straight from suns, and the mean of all other light
/// of that side; the shaded part receives the latter alone. Of a group, organs count by their
/// sunlit or shaded areas. Sunlit light is unknown where no sun shines.
struct SunShadeLight {
    std::size_t bands = 0;
    /// [(row * kSunShadeQuantities + quantity) * bands + band], a row for each organ or group; see
    /// at(). Empty unless RunSpec::sun_shade is `apart`.
    std::vector<Estimate> values = {};

    /// Fractions have the same value in each band.
    [[nodiscard]] Estimate at(std::size_t row, SunShadeQuantity q, std::size_t band = 0) const {
        return values[(row * kSunShadeQuantities + static_cast<std::size_t>(q)) * bands + band];
    }
    [[nodiscard]] bool empty() const { return values.empty(); }
    [[nodiscard]] std::size_t values_per_row() const { return kSunShadeQuantities * bands; }
};

}  // namespace quasimc

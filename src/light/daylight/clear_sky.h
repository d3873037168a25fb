#pragma once

#include "light/daylight/daylight.h"

namespace quasimc {

/// The cloudless air above a site.
struct ClearAir {
    double linke_turbidity = 3;     ///< at air mass 2; 2 very clear, 3 rural, 5 polluted or humid
    double elevation_m = 0;         ///< of the site
    double pressure_hpa = 1013.25;  ///< at the site
};

/// Solar radiation above the atmosphere at 1 au: 1360.8 W m-2 (Kopp and Lean 2011).
inline constexpr double kSolarConstant = 1360.8;

/// Length of the sun's path through the air relative to the vertical (Kasten and Young 1989,
/// Applied Optics 28: 4735), at sea level.
/// @param elevation_deg  of the sun, refracted, -1 to 90
[[nodiscard]] double relative_air_mass(double elevation_deg);
/// Overload for callers that already have the sine of the elevation.
[[nodiscard]] double relative_air_mass(double elevation_deg, double sine);

/// Daylight under a sky without clouds (Ineichen and Perez 2002, Solar Energy 73: 151-157).
/// @param elevation_deg  of the sun, refracted; no light at 0 or below
/// @param facing         extraterrestrial irradiance facing the sun, W m-2: kSolarConstant over the
///                       square of the distance in au
[[nodiscard]] Daylight clear_sky(double elevation_deg, double facing, const ClearAir& air);

}  // namespace quasimc

#pragma once

#include <span>
#include <string_view>

namespace quasimc {

/// Means below and above 700 nm, weighted by daylight.
struct OpticsByRegion {
    double visible = 0, near_infrared = 0;  ///< 0 to 1
};

/// Reference optics of leaves and stems, for want of measurements. See
/// docs/theory/leaf-and-soil-models.md.
struct DefaultOptics {
    std::string_view name, summary;
    OpticsByRegion reflectance, transmittance;
};

/// All reference optics. Lawrence et al. (2018), Technical description of version 5.0 of the
/// Community Land Model, table of plant functional types' optical properties.
[[nodiscard]] std::span<const DefaultOptics> usual_optics();
[[nodiscard]] const DefaultOptics* find_usual_optics(std::string_view name);

inline constexpr int kSoilColors = 20;

/// Reflectance of bare soil: that of saturated soil plus 0.11 - 0.4 water, limited to the range
/// from saturated to dry soil. Ibid., equation of soil albedos and table of soil colours.
/// @param color  1 (bright) to kSoilColors (dark)
/// @param water  volume of water over that of soil, 0 to 1
[[nodiscard]] OpticsByRegion soil_reflectance(int color, double water);

}  // namespace quasimc

#pragma once

#include <span>

namespace quasimc {

/// The geocentric position of the sun, and its intermediate values; degrees.
struct GeocentricSun {
    double earth_longitude = 0, earth_latitude = 0;  ///< heliocentric
    double distance_au = 1;
    double nutation_longitude = 0, nutation_obliquity = 0;
    double obliquity = 0;           ///< of the ecliptic, true
    double apparent_longitude = 0;  ///< of the sun: with aberration and nutation
    double sidereal_time = 0;       ///< apparent, at Greenwich
    double right_ascension = 0, declination = 0;
    double mean_longitude = 0;  ///< of the sun
};

/// Algorithm of Reda and Andreas (2004), sections 3.2 to 3.10.
/// @param julian_day  universal time
/// @param delta_t_s   terrestrial less universal time [s]
[[nodiscard]] GeocentricSun geocentric_sun(double julian_day, double delta_t_s);

/// An angle reduced to 0 <= angle < 360.
[[nodiscard]] double full_turn(double degrees);

/// coefficients[0] + coefficients[1] x + coefficients[2] x^2 ...
[[nodiscard]] double polynomial(double x, std::span<const double> coefficients);

}  // namespace quasimc

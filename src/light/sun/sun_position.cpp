#include <cmath>

#include "base/angles.h"
#include "base/checks.h"
#include "light/sun/sun_ephemeris.h"
#include "quasimc/source.h"

namespace quasimc {
namespace {

/// Right ascension, declination and hour angle as seen from a site on the Earth's surface,
/// corrected for the sun's parallax (section 3.12).
void set_topocentric(const Site& site, double distance_au, SunIntermediates& values) {
    constexpr double kAxisRatio = 0.99664719;
    constexpr double kEarthRadius = 6378140;
    const double phi = kRadians * site.latitude_deg;
    const double parallax = kRadians * 8.794 / (3600 * distance_au);
    const double u = std::atan(kAxisRatio * std::tan(phi));
    const double height = site.elevation_m / kEarthRadius;
    const double x = std::cos(u) + height * std::cos(phi);
    const double y = kAxisRatio * std::sin(u) + height * std::sin(phi);
    const double hour_angle = kRadians * values.hour_angle_deg;
    const double delta = kRadians * values.declination_deg;
    const double near = std::cos(delta) - x * std::sin(parallax) * std::cos(hour_angle);
    const double shift = std::atan2(-x * std::sin(parallax) * std::sin(hour_angle), near);
    values.topocentric_right_ascension_deg = values.right_ascension_deg + shift / kRadians;
    values.topocentric_declination_deg =
        std::atan2((std::sin(delta) - y * std::sin(parallax)) * std::cos(shift), near) / kRadians;
    values.topocentric_hour_angle_deg = values.hour_angle_deg - shift / kRadians;
}

/// Refraction [degrees]; 0 once the whole disk is below the horizon (section 3.14).
double refraction_deg(const Site& site, double true_elevation_deg) {
    constexpr double kSunRadius = 0.26667;
    constexpr double kAtHorizon = 0.5667;
    if (true_elevation_deg < -(kSunRadius + kAtHorizon)) {
        return 0;
    }
    const double angle = true_elevation_deg + 10.3 / (true_elevation_deg + 5.11);
    return site.pressure_hpa / 1010 * 283 / (273 + site.temperature_c) * 1.02 /
           (60 * std::tan(kRadians * angle));
}

double equation_of_time_min(const GeocentricSun& sun) {
    double minutes = 4 * (sun.mean_longitude - 0.0057183 - sun.right_ascension +
                          sun.nutation_longitude * std::cos(kRadians * sun.obliquity));
    // A full turn is a day; the equation itself is within 20 minutes.
    minutes -= 1440 * std::round(minutes / 1440);
    return minutes;
}

}  // namespace

SunPosition sun_position(const Site& site, const CivilTime& time, std::optional<double> delta_t_s) {
    const double day = julian_day(time);
    const GeocentricSun sun = geocentric_sun(day, delta_t_s.value_or(delta_t_seconds(time)));
    SunPosition position;
    SunIntermediates& values = position.intermediates;
    values.julian_day = day;
    values.earth_longitude_deg = sun.earth_longitude;
    values.earth_latitude_deg = sun.earth_latitude;
    values.nutation_longitude_deg = sun.nutation_longitude;
    values.nutation_obliquity_deg = sun.nutation_obliquity;
    values.obliquity_deg = sun.obliquity;
    values.apparent_longitude_deg = sun.apparent_longitude;
    values.sidereal_time_deg = sun.sidereal_time;
    values.right_ascension_deg = sun.right_ascension;
    values.declination_deg = sun.declination;
    values.hour_angle_deg = full_turn(sun.sidereal_time + site.longitude_deg - sun.right_ascension);
    set_topocentric(site, sun.distance_au, values);

    const double phi = kRadians * site.latitude_deg;
    const double delta = kRadians * values.topocentric_declination_deg;
    const double hour_angle = kRadians * values.topocentric_hour_angle_deg;
    position.true_elevation_deg = std::asin(
                                      std::sin(phi) * std::sin(delta) +
                                      std::cos(phi) * std::cos(delta) * std::cos(hour_angle)) /
                                  kRadians;
    position.elevation_deg =
        position.true_elevation_deg + refraction_deg(site, position.true_elevation_deg);
    const double from_south = std::atan2(
        std::sin(hour_angle),
        std::cos(hour_angle) * std::sin(phi) - std::tan(delta) * std::cos(phi));
    position.azimuth_deg = full_turn(from_south / kRadians + 180);
    position.distance_au = sun.distance_au;
    position.declination_deg = sun.declination;
    position.equation_of_time_min = equation_of_time_min(sun);
    return position;
}

}  // namespace quasimc

#include "light/sun/sun_ephemeris.h"

#include <array>
#include <cmath>

#include "base/angles.h"
#include "light/sun/sun_terms.h"

namespace quasimc {
namespace {

/// 1 January 2000, 12 h.
constexpr double kJ2000 = 2451545;

double sum_of(std::span<const spa::Term> terms, double millennia) {
    double sum = 0;
    for (const spa::Term& term : terms) {
        sum += term.a * std::cos(term.b + term.c * millennia);
    }
    return sum;
}

/// Sums of the tables, 1e-8 radians or astronomical units.
struct Heliocentric {
    double longitude, latitude, radius;
};

Heliocentric heliocentric(double millennia) {
    const std::array longitude{sum_of(spa::kL0, millennia), sum_of(spa::kL1, millennia),
                               sum_of(spa::kL2, millennia), sum_of(spa::kL3, millennia),
                               sum_of(spa::kL4, millennia), sum_of(spa::kL5, millennia)};
    const std::array latitude{sum_of(spa::kB0, millennia), sum_of(spa::kB1, millennia)};
    const std::array radius{
        sum_of(spa::kR0, millennia), sum_of(spa::kR1, millennia), sum_of(spa::kR2, millennia),
        sum_of(spa::kR3, millennia), sum_of(spa::kR4, millennia)};
    constexpr double kUnit = 1e-8;
    return {
        kUnit * polynomial(millennia, longitude), kUnit * polynomial(millennia, latitude),
        kUnit * polynomial(millennia, radius)};
}

/// Sets the nutation at a time, in Julian centuries of terrestrial time from 2000.
void add_nutation(double centuries, GeocentricSun& sun) {
    // Elongation of the moon, anomalies of sun and moon, the moon's argument of latitude and node.
    constexpr std::array<std::array<double, 4>, 5> kAngles{
        {{297.85036, 445267.111480, -0.0019142, 1.0 / 189474},
         {357.52772, 35999.050340, -0.0001603, -1.0 / 300000},
         {134.96298, 477198.867398, 0.0086972, 1.0 / 56250},
         {93.27191, 483202.017538, -0.0036825, 1.0 / 327270},
         {125.04452, -1934.136261, 0.0020708, 1.0 / 450000}}};
    std::array<double, 5> angles{};
    for (std::size_t i = 0; i < angles.size(); ++i) {
        angles[i] = kRadians * polynomial(centuries, kAngles[i]);
    }
    for (const spa::NutationTerm& term : spa::kNutation) {
        double argument = 0;
        for (std::size_t i = 0; i < angles.size(); ++i) {
            argument += angles[i] * term.y[i];
        }
        sun.nutation_longitude += (term.a + term.b * centuries) * std::sin(argument);
        sun.nutation_obliquity += (term.c + term.d * centuries) * std::cos(argument);
    }
    constexpr double kUnit = 1 / 36000000.0;  // 0.0001 seconds of arc
    sun.nutation_longitude *= kUnit;
    sun.nutation_obliquity *= kUnit;
}

/// Obliquity of the ecliptic, without nutation.
double mean_obliquity(double millennia) {
    constexpr std::array kCoefficients{84381.448, -4680.93, -1.55, 1999.25, -51.38, -249.67,
                                       -39.05,    7.12,     27.87, 5.79,    2.45};
    return polynomial(millennia / 10, kCoefficients) / 3600;
}

/// Mean sidereal time at Greenwich, without nutation; by universal time.
double mean_sidereal_time(double julian_day) {
    const double centuries = (julian_day - kJ2000) / 36525;
    return full_turn(
        280.46061837 + 360.98564736629 * (julian_day - kJ2000) +
        centuries * centuries * (0.000387933 - centuries / 38710000));
}

double sun_mean_longitude(double millennia) {
    constexpr std::array kCoefficients{280.4664567, 360007.6982779, 0.03032028,
                                       1.0 / 49931, -1.0 / 15300,   -1.0 / 2000000};
    return full_turn(polynomial(millennia, kCoefficients));
}

}  // namespace

double full_turn(double degrees) {
    const double rest = std::fmod(degrees, 360);
    return rest < 0 ? rest + 360 : rest;
}

double polynomial(double x, std::span<const double> coefficients) {
    double value = 0;
    for (std::size_t i = coefficients.size(); i > 0; --i) {
        value = value * x + coefficients[i - 1];
    }
    return value;
}

GeocentricSun geocentric_sun(double julian_day, double delta_t_s) {
    const double centuries = (julian_day + delta_t_s / 86400 - kJ2000) / 36525;
    const double millennia = centuries / 10;
    const Heliocentric earth = heliocentric(millennia);
    GeocentricSun sun;
    sun.earth_longitude = full_turn(earth.longitude / kRadians);
    sun.earth_latitude = earth.latitude / kRadians;
    sun.distance_au = earth.radius;
    add_nutation(centuries, sun);
    sun.obliquity = mean_obliquity(millennia) + sun.nutation_obliquity;
    const double aberration = -20.4898 / (3600 * earth.radius);
    sun.apparent_longitude =
        full_turn(sun.earth_longitude + 180 + sun.nutation_longitude + aberration);
    const double tilt = kRadians * sun.obliquity;
    const double lambda = kRadians * sun.apparent_longitude;
    const double beta = -earth.latitude;
    sun.sidereal_time = mean_sidereal_time(julian_day) + sun.nutation_longitude * std::cos(tilt);
    sun.right_ascension = full_turn(
        std::atan2(
            std::sin(lambda) * std::cos(tilt) - std::tan(beta) * std::sin(tilt), std::cos(lambda)) /
        kRadians);
    sun.declination =
        std::asin(
            std::sin(beta) * std::cos(tilt) + std::cos(beta) * std::sin(tilt) * std::sin(lambda)) /
        kRadians;
    sun.mean_longitude = sun_mean_longitude(millennia);
    return sun;
}

}  // namespace quasimc

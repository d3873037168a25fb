#include "light/daylight/clear_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasimc {
namespace {

constexpr double kSeaLevelHpa = 1013.25;

}  // namespace

double relative_air_mass(double elevation_deg) {
    return relative_air_mass(elevation_deg, std::sin(elevation_deg * std::numbers::pi / 180));
}

double relative_air_mass(double elevation_deg, double sine) {
    return 1 / (sine + 0.50572 * std::pow(elevation_deg + 6.07995, -1.6364));
}

Daylight clear_sky(double elevation_deg, double facing, const ClearAir& air) {
    if (elevation_deg <= 0) {
        return {};
    }
    const double h = air.elevation_m;
    const double turbidity = air.linke_turbidity;
    const double mass = relative_air_mass(elevation_deg) * air.pressure_hpa / kSeaLevelHpa;
    const double sine = std::sin(elevation_deg * std::numbers::pi / 180);
    const double f1 = std::exp(-h / 8000);
    const double f2 = std::exp(-h / 1250);
    const double a1 = 5.09e-5 * h + 0.868;
    const double a2 = 3.92e-5 * h + 0.0387;
    const double global = a1 * facing * sine * std::exp(-a2 * mass * (f1 + f2 * (turbidity - 1)));
    // Beam, and an upper bound of it: some light always comes from the sky.
    const double b = 0.664 + 0.163 / f1;
    const double beam = b * facing * std::exp(-0.09 * mass * (turbidity - 1));
    const double bound =
        global * (1 - (0.1 - 0.2 * std::exp(-turbidity)) / (0.1 + 0.882 / f1)) / sine;
    const double direct = std::max(0.0, std::min(beam, bound)) * sine;
    return {direct, global - direct};
}

}  // namespace quasimc

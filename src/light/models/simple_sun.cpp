// The sun of the original program's specifications, without its errors: time zones are multiples of
// 15 degrees (not 12), and solar time is ahead in the east (not in the west).

#include <algorithm>
#include <cmath>
#include <numbers>

#include "quasimc/source.h"

namespace quasimc {

double nautical_utc_offset(double longitude_deg) {
    return std::round(longitude_deg / 15);
}

SimpleSun simple_sun_position(
    double latitude_deg,
    double longitude_deg,
    double day_of_year,
    double clock_hours,
    double utc_offset_hours) {
    using std::numbers::pi;
    const double delta = 0.4093 * std::sin(2 * pi * (day_of_year - 81) / 368);
    const double equation_of_time = 0.170 * std::sin(4 * pi * (day_of_year - 80) / 373) -
                                    0.129 * std::sin(2 * pi * (day_of_year - 8) / 355);
    const double solar_hours =
        clock_hours + equation_of_time + longitude_deg / 15 - utc_offset_hours;
    const double hour_angle = pi * (solar_hours - 12) / 12;
    const double phi = latitude_deg * pi / 180;
    // The direction to the sun: east, north, up.
    const double east = -std::cos(delta) * std::sin(hour_angle);
    const double north =
        std::cos(phi) * std::sin(delta) - std::sin(phi) * std::cos(delta) * std::cos(hour_angle);
    const double up =
        std::sin(phi) * std::sin(delta) + std::cos(phi) * std::cos(delta) * std::cos(hour_angle);
    const double azimuth = std::atan2(east, north) * 180 / pi;
    return {azimuth < 0 ? azimuth + 360 : azimuth, std::asin(std::clamp(up, -1.0, 1.0)) * 180 / pi};
}

}  // namespace quasimc

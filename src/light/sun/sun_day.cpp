// Rise, transit and set. The report interpolates the sun between three days; here every iteration
// computes the sun anew, for the day is that of the site's clock, not that of Greenwich, and may
// lie up to a day and a half from it.

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "light/sun/sun_ephemeris.h"
#include "quasimc/source.h"

namespace quasimc {
namespace {

/// True elevation of the sun's centre at rise and set: refraction 34', radius 16'.
constexpr double kRiseElevation = -0.8333;

/// The sun at a site as a function of time.
class SunTrack {
  public:
    SunTrack(const Site& site, double delta_t_s) : site_(site), delta_t_s_(delta_t_s) {}

    /// The transit nearest to a time (Julian days).
    [[nodiscard]] double transit(double julian_day) const {
        constexpr int kSteps = 5;  // the first leaves less than a minute
        for (int i = 0; i < kSteps; ++i) {
            const double turned = hour_angle(geocentric_sun(julian_day, delta_t_s_));
            julian_day -= (turned > 180 ? turned - 360 : turned) / 360;
        }
        return julian_day;
    }

    /// Elevation above that of rise and set [degrees], seen from the Earth's centre.
    [[nodiscard]] double height(double julian_day) const {
        const GeocentricSun sun = geocentric_sun(julian_day, delta_t_s_);
        const double phi = kRadians * site_.latitude_deg;
        const double delta = kRadians * sun.declination;
        const double sine = std::sin(phi) * std::sin(delta) +
                            std::cos(phi) * std::cos(delta) * std::cos(kRadians * hour_angle(sun));
        return std::asin(std::clamp(sine, -1.0, 1.0)) / kRadians - kRiseElevation;
    }

    /// The time when the sun crosses the horizon, between one with the sun up and one with the sun
    /// down.
    [[nodiscard]] std::optional<double> crossing(double up, double down) const {
        if (height(down) >= 0) {
            return std::nullopt;
        }
        constexpr int kHalvings = 40;
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = 0.5 * (up + down);
            (height(middle) >= 0 ? up : down) = middle;
        }
        return 0.5 * (up + down);
    }

  private:
    [[nodiscard]] double hour_angle(const GeocentricSun& sun) const {
        return full_turn(sun.sidereal_time + site_.longitude_deg - sun.right_ascension);
    }

    Site site_;
    double delta_t_s_;
};

}  // namespace

SunDay sun_day(const Site& site, const CivilTime& date, std::optional<double> delta_t_s) {
    CivilTime noon = date;
    noon.hour = 12;
    noon.minute = 0;
    noon.second = 0;
    const SunTrack path(site, delta_t_s.value_or(delta_t_seconds(date)));
    const double transit = path.transit(julian_day(noon));
    const auto on_the_clock = [&](double julian_day) {
        return civil_time(julian_day, date.utc_offset_hours);
    };
    SunDay day;
    day.transit = on_the_clock(transit);
    day.transit_elevation_deg = path.height(transit) + kRiseElevation;
    if (path.height(transit) < 0) {
        day.kind = DayKind::polar_night;
        return day;
    }
    if (const auto rise = path.crossing(transit, transit - 0.5)) {
        day.sunrise = on_the_clock(*rise);
    }
    if (const auto set = path.crossing(transit, transit + 0.5)) {
        day.sunset = on_the_clock(*set);
    }
    day.kind = day.sunrise || day.sunset ? DayKind::ordinary : DayKind::polar_day;
    return day;
}

}  // namespace quasimc

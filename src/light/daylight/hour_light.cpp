#include "light/daylight/hour_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "base/checks.h"
#include "base/text.h"

namespace quasimc {
namespace {

double sine_of(const SunPosition& sun) {
    return SunPath::is_up(sun) ? std::sin(sun.elevation_deg * std::numbers::pi / 180) : 0;
}

}  // namespace

double SunPath::mean_sine() const {
    double sum = 0;
    for (const SunPosition& sun : steps) {
        sum += sine_of(sun);
    }
    return sum / static_cast<double>(steps.size());
}

const SunPosition& SunPath::middle() const {
    std::vector<const SunPosition*> up;
    for (const SunPosition& sun : steps) {
        if (is_up(sun)) {
            up.push_back(&sun);
        }
    }
    return up.empty() ? steps[steps.size() / 2] : *up[up.size() / 2];
}

double SunPath::highest_deg() const {
    double highest = -90;
    for (const SunPosition& sun : steps) {
        highest = std::max(highest, sun.elevation_deg);
    }
    return highest;
}

double SunPath::outside() const {
    const double distance = middle().distance_au;
    return kSolarConstant / (distance * distance);
}

SunPath sun_path(const Site& site, const CivilTime& start, double seconds, double step) {
    const std::int64_t pieces =
        step > 0 ? std::max<std::int64_t>(1, std::llround(seconds / step)) : 1;
    SunPath path;
    for (std::int64_t i = 0; i < pieces; ++i) {
        const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(pieces);
        path.steps.push_back(sun_position(site, later(start, part * seconds)));
    }
    return path;
}

HourLight clear_light(const SunPath& path, const ClearAir& air) {
    HourLight light;
    const auto steps = static_cast<double>(path.steps.size());
    for (const SunPosition& sun : path.steps) {
        const Daylight now = clear_sky(sun.elevation_deg, path.outside(), air);
        light.daylight.direct += now.direct / steps;
        light.daylight.diffuse += now.diffuse / steps;
        light.facing.push_back(now.direct > 0 ? now.direct / sine_of(sun) : 0);
    }
    return light;
}

HourParts make_hour_parts(const SunPath& path, const HourLight& light, const DaylightSources& how) {
    EXPECT(light.facing.size() == path.steps.size());
    HourParts hour;
    const auto steps = static_cast<double>(path.steps.size());
    for (std::size_t i = 0; i < path.steps.size(); ++i) {
        if (light.facing[i] <= 0) {
            continue;
        }
        const SunPosition& sun = path.steps[i];
        HourParts::Sun& part = hour.suns.emplace_back();
        part.to_sun = how.orientation.towards(sun.azimuth_deg, sun.elevation_deg);
        for (const SpectralSpan& band : how.bands) {
            part.facing.push_back(light.facing[i] / steps * how.spectra.direct(band));
        }
        hour.suns_text +=
            "sun " + shortest(sun.azimuth_deg) + " " + shortest(sun.elevation_deg) + ";";
    }
    if (light.daylight.diffuse <= 0) {
        return hour;
    }
    const SunPosition& sun = path.middle();
    const bool has_beam = light.daylight.direct > 0;
    const SkyEntry* sky = find_sky(has_beam ? how.sky : how.overcast_sky);
    EXPECT(sky != nullptr);
    if (sky->needs != SkyNeeds::nothing && !SunPath::is_up(sun)) {
        sky = find_sky("cie_overcast");
    }
    SkyState state = how.state;
    state.to_sun = how.orientation.towards(sun.azimuth_deg, sun.elevation_deg);
    state.distance_au = sun.distance_au;
    state.direct_normal = has_beam ? light.daylight.direct / path.mean_sine() : 0;
    state.diffuse_horizontal = light.daylight.diffuse;
    for (const SpectralSpan& band : how.bands) {
        hour.sky_horizontal.push_back(how.spectra.diffuse(band, light.daylight));
    }
    hour.sky = sky->make(state);
    hour.sky_text = std::string(sky->name);
    if (sky->needs != SkyNeeds::nothing) {
        hour.sky_text += " " + shortest(sun.azimuth_deg) + " " + shortest(sun.elevation_deg) + " " +
                         shortest(state.direct_normal) + " " + shortest(state.diffuse_horizontal);
    }
    return hour;
}

HourSources make_hour_sources(HourParts parts) {
    HourSources hour;
    for (HourParts::Sun& sun : parts.suns) {
        hour.sources.push_back(make_directional_source("sun", -sun.to_sun, std::move(sun.facing)));
    }
    if (parts.sky) {
        hour.sources.push_back(make_sky("sky", *parts.sky, std::move(parts.sky_horizontal)));
    }
    hour.directional_key = parts.suns_text + parts.sky_text;
    return hour;
}

}  // namespace quasimc

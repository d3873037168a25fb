#include "sources/hour_light.h"

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

/// Direct and diffuse light on the horizontal as a reading has it, in its unit.
struct Parts {
    double direct = 0, diffuse = 0;
};

/// What the beam brings to the horizontal, if it was measured.
std::optional<double> beam_on_horizontal(const Reading& reading, double sine) {
    return reading.beam_normal ? std::optional(*reading.beam_normal * sine) : std::nullopt;
}

/// Direct light on the horizontal, if the reading tells it.
std::optional<double> direct_of(const Reading& reading, double sine) {
    return reading.direct_horizontal ? reading.direct_horizontal
                                     : beam_on_horizontal(reading, sine);
}

/// The parts, if the reading tells them.
std::optional<Parts> parts_of(const Reading& reading, double sine) {
    const std::optional<double> direct = direct_of(reading, sine);
    if (direct && reading.diffuse) {
        return Parts{*direct, *reading.diffuse};
    }
    if (reading.global && direct) {
        return Parts{*direct, *reading.global - *direct};
    }
    if (reading.global && reading.diffuse) {
        return Parts{*reading.global - *reading.diffuse, *reading.diffuse};
    }
    return std::nullopt;
}

/// Whether readings that say the same differ by more than a tenth and what instruments are off.
bool disagree(const Reading& reading, double sine, LightUnit unit, const DaylightSpectra& spectra) {
    constexpr double kPart = 0.1;
    constexpr double kInstruments = 20;  // W m-2
    const auto differ = [&](double a, double b) {
        const double off = std::abs(a - b);
        return off > kPart * std::max(a, b) && spectra.from_global(off, unit) > kInstruments;
    };
    const std::optional<double> beam = beam_on_horizontal(reading, sine);
    const std::optional<double> direct = direct_of(reading, sine);
    return (beam && differ(*direct, *beam)) ||
           (reading.global && direct && reading.diffuse &&
            differ(*reading.global, *direct + *reading.diffuse));
}

/// All of it sky light.
Daylight all_diffuse(double global, LightUnit unit, const DaylightSpectra& spectra) {
    return spectra.from_parts(0, global, unit);
}

/// The beam that brings the direct light, the same at all steps with the sun up.
std::vector<double> even_beam(const SunPath& path, double direct) {
    std::vector<double> facing;
    const double sine = path.mean_sine();
    for (const SunPosition& sun : path.steps) {
        facing.push_back(direct > 0 && SunPath::is_up(sun) ? direct / sine : 0);
    }
    return facing;
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

SunPath sun_path(const Place& place, const CivilTime& start, double seconds, double step) {
    const std::int64_t pieces =
        step > 0 ? std::max<std::int64_t>(1, std::llround(seconds / step)) : 1;
    SunPath path;
    for (std::int64_t i = 0; i < pieces; ++i) {
        const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(pieces);
        path.steps.push_back(sun_position(place, later(start, part * seconds)));
    }
    return path;
}

namespace {

/// What thermopiles and their zeros are off at most where there is hardly any light, W m-2: they
/// read -1 to -5 in clear nights, some -10 and more.
constexpr double kOffset = 20;
/// The same of the difference of two of them.
constexpr double kDifference = 5;

/// Of a reading slightly below zero 0. @returns  whether none is further below
bool settle_offsets(Reading& reading, LightUnit unit, const DaylightSpectra& spectra) {
    bool is_good = true;
    for (std::optional<double>* part :
         {&reading.global, &reading.direct_horizontal, &reading.beam_normal, &reading.diffuse}) {
        if (*part && **part < 0) {
            is_good = is_good && spectra.from_global(-**part, unit) <= kOffset;
            *part = 0;
        }
    }
    return is_good;
}

}  // namespace

HourLight measured_light(
    const SunPath& path,
    const Reading& given,
    LightUnit unit,
    DiffuseModel model,
    const DaylightSpectra& spectra) {
    const double sine = path.mean_sine();
    HourLight light;
    Reading reading = given;
    if (!settle_offsets(reading, unit, spectra)) {
        light.fault = ReadingFault::negative;
        return light;
    }
    std::optional<Parts> parts = parts_of(reading, sine);
    if (!parts && !reading.global) {
        light.fault = ReadingFault::incomplete;
        return light;
    }
    const double global = parts ? parts->direct + parts->diffuse : *reading.global;
    // Sensors read a little off at night; this is more than that.
    constexpr double kNightLight = 50;
    constexpr double kNightDeg = -2;
    if (path.highest_deg() < kNightDeg && spectra.from_global(global, unit) > kNightLight) {
        light.fault = ReadingFault::light_at_night;
    }
    if (parts && (parts->direct < 0 || parts->diffuse < 0)) {
        constexpr double kNoise = 0.1;
        const bool is_all_direct = parts->diffuse < 0;
        const double excess = -std::min(parts->direct, parts->diffuse);
        if (excess > kNoise * global && spectra.from_global(excess, unit) > kDifference) {
            light.fault = ReadingFault::part_exceeds_global;
        }
        light.note = is_all_direct ? ReadingNote::more_direct_than_global
                                   : ReadingNote::more_diffuse_than_global;
        light.note = global > 0 ? light.note : ReadingNote::none;
        parts = is_all_direct ? Parts{global, 0} : Parts{0, global};
    }
    if (global <= 0) {
        light.facing = even_beam(path, 0);
        return light;
    }
    if (parts) {
        light.daylight = spectra.from_parts(parts->direct, parts->diffuse, unit);
    } else if (sine > 0) {
        const double clearness = spectra.from_global(global, unit) / (path.outside() * sine);
        light.daylight =
            spectra.from_fraction(global, unit, diffuse_fraction(model, clearness, sine));
    } else {
        light.daylight = all_diffuse(global, unit, spectra);
    }
    if (light.note == ReadingNote::none && disagree(reading, sine, unit, spectra)) {
        light.note = ReadingNote::parts_disagree;
    }
    if (light.daylight.direct > path.outside() * sine) {
        constexpr double kHighDeg = 10;
        light.note = path.highest_deg() > kHighDeg ? ReadingNote::more_direct_than_outside
                                                   : ReadingNote::sun_too_low;
        light.daylight = all_diffuse(global, unit, spectra);
    }
    light.facing = even_beam(path, light.daylight.direct);
    return light;
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
    hour.shapes = parts.suns_text + parts.sky_text;
    return hour;
}

HourSources make_hour_sources(
    const SunPath& path, const HourLight& light, const DaylightSources& how) {
    return make_hour_sources(make_hour_parts(path, light, how));
}

}  // namespace quasimc

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "base/angles.h"
#include "base/text.h"
#include "commands.h"
#include "files/atomic_file.h"
#include "light/daylight/clear_sky.h"
#include "light/daylight/daylight.h"
#include "light/models/source.h"
#include "picture/sky_plot.h"
#include "quasimc/quasimc.h"
#include "quasimc/source.h"
#include "show_colors.h"
#include "text/numbers.h"
#include "weather/civil_time_text.h"

namespace {

using quasimc::shortest;
using quasimc::Vec3;

struct SkyArguments {
    std::string site, time, sky, png;
    double elevation_m = 0;
    std::optional<double> pressure_hpa, temperature_c, delta_t_s;
    int cie_type = 12;
    double linke_turbidity = 3;
    double turbidity = 3, direct_normal = 0, diffuse_horizontal = 0;
    std::size_t size = 512;
};

/// The site, from "LAT,LON"; nothing after an error.
std::optional<quasimc::Site> site_of(const SkyArguments& arguments, quasimc::Faults& faults) {
    const std::string_view text = arguments.site;
    const std::size_t comma = text.find(',');
    const auto latitude = quasimc::parse_real(quasimc::trimmed(text.substr(0, comma)));
    const auto longitude = comma == std::string_view::npos
                               ? std::nullopt
                               : quasimc::parse_real(quasimc::trimmed(text.substr(comma + 1)));
    if (!latitude || !longitude) {
        faults.add(
            {"--site", fmt::format("'{}' is not a site", text), "",
             "give latitude and longitude in degrees, north and east positive: 50.1,8.7"});
        return std::nullopt;
    }
    quasimc::Site site{*latitude, *longitude, arguments.elevation_m};
    site.pressure_hpa =
        arguments.pressure_hpa.value_or(quasimc::standard_pressure_hpa(arguments.elevation_m));
    site.temperature_c = arguments.temperature_c.value_or(site.temperature_c);
    quasimc::check_site(site, "--site", faults);
    return site;
}

std::string sky_row(std::string_view name, const std::string& text) {
    return fmt::format("{:<10}{}\n", name, text);
}

std::string clock_text(const std::optional<quasimc::CivilTime>& time) {
    return time ? quasimc::civil_time_text(*time) : "none";
}

std::string day_text(const quasimc::SunDay& day) {
    switch (day.kind) {
        case quasimc::DayKind::polar_day:
            return fmt::format(
                "polar day, the sun does not set; transit {}", clock_text(day.transit));
        case quasimc::DayKind::polar_night:
            return fmt::format(
                "polar night, the sun does not rise; transit {}", clock_text(day.transit));
        default:
            return fmt::format(
                "sunrise {}, transit {} at {:.2f} deg, sunset {}", clock_text(day.sunrise),
                clock_text(day.transit), day.transit_elevation_deg, clock_text(day.sunset));
    }
}

std::string sun_text(
    const quasimc::Site& site,
    const quasimc::CivilTime& time,
    const quasimc::SunPosition& sun,
    const Vec3& to_sun) {
    return sky_row(
               "site", fmt::format(
                           "latitude {}, longitude {}, {} m, {:.1f} hPa, {:.1f} C",
                           shortest(site.latitude_deg), shortest(site.longitude_deg),
                           shortest(site.elevation_m), site.pressure_hpa, site.temperature_c)) +
           sky_row(
               "time", fmt::format(
                           "{}, Julian day {:.6f} (UTC)", quasimc::civil_time_text(time),
                           sun.intermediates.julian_day)) +
           sky_row(
               "sun", fmt::format(
                          "azimuth {:.4f} deg (from north over east), elevation {:.4f} deg ({:.4f} "
                          "without refraction)",
                          sun.azimuth_deg, sun.elevation_deg, sun.true_elevation_deg)) +
           sky_row(
               "", fmt::format(
                       "towards ({:.6f}, {:.6f}, {:.6f}): east, north, up", to_sun.x, to_sun.y,
                       to_sun.z)) +
           sky_row(
               "", fmt::format(
                       "declination {:.4f} deg, equation of time {:.2f} min, distance {:.6f} au, "
                       "radius {:.4f} deg",
                       sun.declination_deg, sun.equation_of_time_min, sun.distance_au,
                       quasimc::solar_radius_deg(sun.distance_au)));
}

/// Irradiance of the sun and a cloudless sky.
std::string clear_text(
    const quasimc::Site& site, const quasimc::SunPosition& sun, double linke_turbidity) {
    const double outside = quasimc::kSolarConstant / (sun.distance_au * sun.distance_au);
    const quasimc::Daylight light = quasimc::clear_sky(
        sun.elevation_deg, outside, {linke_turbidity, site.elevation_m, site.pressure_hpa});
    if (light.global() <= 0) {
        return sky_row("clear sky", "no light: the sun is below the horizon");
    }
    const quasimc::DaylightSpectra spectra;
    const quasimc::SpectralSpan ppfd = quasimc::span_of(quasimc::LightUnit::ppfd);
    return sky_row(
               "clear sky", fmt::format(
                                "on the horizontal {:.1f} W m-2, direct {:.1f} and diffuse {:.1f}; "
                                "beam {:.1f} W m-2",
                                light.global(), light.direct, light.diffuse,
                                light.direct / std::sin(sun.elevation_deg * quasimc::kRadians))) +
           sky_row(
               "", fmt::format(
                       "PPFD {:.1f} umol m-2 s-1, direct {:.1f} and diffuse {:.1f}; Linke "
                       "turbidity {}",
                       spectra.direct(ppfd) * light.direct + spectra.diffuse(ppfd, light),
                       spectra.direct(ppfd) * light.direct, spectra.diffuse(ppfd, light),
                       shortest(linke_turbidity)));
}

/// Irradiance of a sky on a plate of normal n, for 1 on the horizontal.
double on_plate(const quasimc::Source& sky, const Vec3& n) {
    constexpr int kSide = 400;
    double sum = 0;
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
            const auto seen = model_of(sky).illuminate({}, (i + 0.5) / kSide, (j + 0.5) / kSide);
            sum += seen.weight * std::max(0.0, dot(seen.to_light, n));
        }
    }
    return sum / (kSide * kSide);
}

std::string sky_text(const quasimc::Source& sky, const quasimc::SkyEntry& entry) {
    constexpr std::array<std::pair<std::string_view, Vec3>, 4> kSides{
        {{"north", {0, 1, 0}}, {"east", {1, 0, 0}}, {"south", {0, -1, 0}}, {"west", {-1, 0, 0}}}};
    std::string plates;
    for (const auto& [name, normal] : kSides) {
        plates +=
            fmt::format("{}{} {:.4f}", plates.empty() ? "" : ", ", name, on_plate(sky, normal));
    }
    return sky_row("sky", fmt::format("{}: {}", entry.name, entry.summary)) +
           sky_row(
               "", fmt::format(
                       "for an irradiance of 1 on the horizontal: radiance of the zenith {:.4f} "
                       "per sr,",
                       model_of(sky).radiance({0, 0, 1}))) +
           sky_row("", fmt::format("on vertical plates that face {}", plates));
}

void write_png(const SkyArguments& arguments, const quasimc::Source& sky, const Vec3& to_sun) {
    quasimc::AtomicFile file(arguments.png);
    file.write(to_png(quasimc::plot_sky(sky, to_sun, arguments.size)));
    file.commit();
}

/// The requested sky; null, with an error added, if it lacks its irradiance or a sun.
std::shared_ptr<const quasimc::Source> sky_of(
    const quasimc::SkyEntry& entry, const quasimc::SkyState& state, quasimc::Faults& faults) {
    if (entry.needs == quasimc::SkyNeeds::sun_and_weather && state.diffuse_horizontal <= 0) {
        faults.add(
            {"--sky", fmt::format("{} needs the light of the hour", entry.name), "",
             "give --diffuse-horizontal and --direct-normal, W m-2"});
        return nullptr;
    }
    if (entry.needs != quasimc::SkyNeeds::nothing && state.to_sun.z <= 0) {
        faults.add(
            {"--sky", "the sun is below the horizon",
             fmt::format("{} describes daytime skies", entry.name),
             "use --sky cie_overcast or uniform"});
        return nullptr;
    }
    return quasimc::make_sky(std::string(entry.name), entry.make(state), {1.0});
}

Exit show_sky(const SkyArguments& arguments) {
    if (!arguments.png.empty()) {
        require_pictures("--png");
        check_picture_name("--png", arguments.png);
    }
    quasimc::Faults faults;
    const auto site = site_of(arguments, faults);
    const auto time = quasimc::parse_civil_time(
        arguments.time, std::nullopt, "--time", faults, quasimc::OffsetKey::none);
    faults.throw_if_any();
    const quasimc::SunPosition sun = quasimc::sun_position(*site, *time, arguments.delta_t_s);
    const Vec3 to_sun = quasimc::Orientation().towards(sun.azimuth_deg, sun.elevation_deg);
    std::string text =
        sun_text(*site, *time, sun, to_sun) +
        sky_row("day", day_text(quasimc::sun_day(*site, *time, arguments.delta_t_s))) +
        clear_text(*site, sun, arguments.linke_turbidity);
    const bool is_asked = !arguments.sky.empty();
    if (is_asked || to_sun.z > 0) {
        const quasimc::SkyEntry& entry = *quasimc::find_sky(is_asked ? arguments.sky : "cie_clear");
        const quasimc::SkyState state{
            to_sun,
            arguments.cie_type,
            arguments.turbidity,
            arguments.direct_normal,
            arguments.diffuse_horizontal,
            sun.distance_au};
        const auto sky = sky_of(entry, state, faults);
        faults.throw_if_any();
        text += sky_text(*sky, entry);
        if (!arguments.png.empty()) {
            write_png(arguments, *sky, to_sun);
        }
    } else if (!arguments.png.empty()) {
        throw quasimc::InputError(
            {{"--png", "there is no sky to be drawn", "the sun is below the horizon",
              "name one by --sky cie_overcast or --sky uniform"}});
    }
    std::fputs(text.c_str(), arguments.png == "-" ? stderr : stdout);
    return Exit::done;
}

std::vector<Flag> flags_of(SkyArguments& arguments) {
    std::vector<std::string> skies;
    for (const quasimc::SkyEntry& entry : quasimc::sky_catalogue()) {
        skies.emplace_back(entry.name);
    }
    return {
        {.name = "--site",
         .target = &arguments.site,
         .summary = "latitude and longitude in degrees, north and east positive",
         .required = true,
         .type_name = "LAT,LON"},
        {.name = "--time",
         .target = &arguments.time,
         .summary = "time with its time zone: 2024-06-21T12:00+02:00",
         .required = true,
         .type_name = "TIME"},
        {"--elevation-m", &arguments.elevation_m, "height above the sea, m"},
        {"--pressure-hpa", &arguments.pressure_hpa, "air pressure; default from the elevation"},
        {"--temperature-c", &arguments.temperature_c, "air temperature; default 12"},
        {"--delta-t-s", &arguments.delta_t_s, "terrestrial minus universal time, s"},
        {.name = "--linke-turbidity",
         .target = &arguments.linke_turbidity,
         .summary = "Linke turbidity of the clear air",
         .range = {{1, 10}},
         .default_text = "3"},
        {.name = "--sky",
         .target = &arguments.sky,
         .summary = "model of the sky; default cie_clear by day",
         .choices = skies},
        {.name = "--cie-type",
         .target = &arguments.cie_type,
         .summary = "type of cie_general",
         .range = {{1, 15}},
         .default_text = "12"},
        {.name = "--turbidity",
         .target = &arguments.turbidity,
         .summary = "turbidity of preetham",
         .range = {{quasimc::kLowestTurbidity, quasimc::kHighestTurbidity}},
         .default_text = "3"},
        {"--direct-normal", &arguments.direct_normal, "of perez, W m-2"},
        {"--diffuse-horizontal", &arguments.diffuse_horizontal, "of perez, W m-2"},
        {.name = "--png",
         .target = &arguments.png,
         .summary = "draw the sky as a fisheye picture, - for standard output",
         .type_name = "FILE"},
        {.name = "--size",
         .target = &arguments.size,
         .summary = "width and height in pixels",
         .range = {{64, 4096}},
         .default_text = "512"}};
}

}  // namespace

Command sky_command() {
    const auto arguments = std::make_shared<SkyArguments>();
    return {
        "sky", "print the position of the sun and the light of the sky, and draw the sky",
        flags_of(*arguments), [arguments] { return show_sky(*arguments); }};
}

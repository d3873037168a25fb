// Directives for sources and for the scattering of surfaces.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "coupling/sky_file.h"
#include "coupling/vlab/directive_table.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

void read_model(Values& values, DirectiveContext& context) {
    constexpr std::array<std::string_view, 5> kNames{
        "lambertian", "modified", "phong", "blinn", "parcinopy"};
    constexpr std::array<std::string_view, 5> kModels{
        "lambertian", "clipped_blinn_phong", "phong", "blinn_phong", "phong"};
    const auto chosen = values.choice(kNames);
    if (!chosen) {
        return;
    }
    context.spec.light_model = kModels[*chosen];
    if (kNames[*chosen] == "parcinopy") {
        values.notice("the PARCINOPY lobe is unknown; Phong's is used");
    }
}

void add_light(const Vec3& travel, double weight, Values& values, DirectiveContext& context) {
    if (travel == Vec3{}) {
        values.fault("the direction is 0 0 0", "it has no direction");
        return;
    }
    const bool is_towards = context.spec.kind == SpecificationKind::montecarlo;
    context.spec.lights.push_back({is_towards ? -travel : travel, weight});
}

void read_light(Values& values, DirectiveContext& context) {
    const auto x = values.number("x of the direction");
    const auto y = values.number("y of the direction");
    const auto z = values.number("z of the direction");
    if (x && y && z && values.at_end()) {
        values.notice(
            "no weight: 1 is used; the original program ignores such a light and uses light from "
            "above if there is no other");
    }
    const auto weight = values.number_or(1, "the weight", kNotNegativeNumber);
    if (x && y && z && weight) {
        add_light({*x, *y, *z}, *weight, values, context);
    }
}

/// The direction of travel of light from a point of the sky: angles in radians.
Vec3 travel_from(double zenith, double azimuth) {
    return {
        std::sin(azimuth) * std::sin(zenith), -std::cos(zenith),
        std::cos(azimuth) * std::sin(zenith)};
}

/// A line of a file of lights: zenith angle, azimuth, weight; or x y z weight.
void read_light_line(Values& line, DirectiveContext& context) {
    std::array<double, 4> n{};
    std::size_t count = 0;
    for (; count < n.size() && !line.at_end(); ++count) {
        const auto value = line.number("a number");
        if (!value) {
            return;
        }
        n[count] = *value;
    }
    if (count < 3) {
        line.fault(
            fmt::format("{} numbers", count),
            "a line needs zenith angle, azimuth and weight, or x, y, z and weight");
        return;
    }
    const double weight = n[count - 1];
    if (weight < 0) {
        line.fault(fmt::format("the weight is {}", shortest(weight)), "it must be 0 or more");
        return;
    }
    add_light(count == 4 ? Vec3{n[0], n[1], n[2]} : travel_from(n[0], n[1]), weight, line, context);
}

void read_light_file(Values& values, DirectiveContext& context) {
    const std::string name = values.rest();
    const auto text = file_text(name, values, context);
    if (!text) {
        return;
    }
    LineScanner lines(*text);
    std::size_t faults = 0;
    while (lines.next() && faults < 20) {
        const std::string_view content = trimmed(lines.line());
        if (content.empty() || content.starts_with("//")) {
            continue;
        }
        Values line(
            fmt::format("{}:{}", name, lines.number()), "light", content, values.faults(),
            context.notices);
        read_light_line(line, context);
        line.finish();
        faults += line.failed() ? 1 : 0;
    }
}

SkyOfDay& sky_of(DirectiveContext& context) {
    if (!context.spec.sky) {
        context.spec.sky.emplace();
    }
    return *context.spec.sky;
}

void read_location(Values& values, DirectiveContext& context) {
    const auto latitude = values.number("the latitude", {-90, 90});
    const auto longitude = values.number("the longitude", {-360, 360});
    if (latitude && longitude) {
        sky_of(context).latitude_deg = *latitude;
        sky_of(context).longitude_deg = *longitude;
    }
}

void read_weather(Values& values, DirectiveContext& context) {
    const auto clear = values.number("the kind of sky, 1 clear or 0 overcast");
    const auto turbidity = values.number_or(2.45, "the turbidity", kTurbidities);
    if (clear && turbidity) {
        sky_of(context).weather = *clear > 0 ? Weather::clear : Weather::overcast;
        sky_of(context).turbidity = std::max(*turbidity, kClearestSky);
        if (*clear > 0 && *turbidity < kClearestSky) {
            values.notice(fmt::format(
                "turbidity {}: the clear sky for {} is used, the lower limit of the formula",
                shortest(*turbidity), shortest(kClearestSky)));
        }
    }
}

void read_period(Values& values, DirectiveContext& context) {
    const auto from = values.number("the first hour", {0, 24});
    const auto until = values.number("the last hour", {0, 24});
    if (from && until && *from > *until) {
        values.fault(
            fmt::format("from {} to {}", shortest(*from), shortest(*until)),
            "the last hour must not come before the first");
    } else if (from && until) {
        sky_of(context).from_hour = *from;
        sky_of(context).until_hour = *until;
    }
}

void read_day(Values& values, DirectiveContext& context) {
    if (const auto day = values.number("the day of the year", {1, 366})) {
        sky_of(context).day = *day;
    }
}

void read_sun(Values& values, DirectiveContext& context) {
    if (const auto on = values.yes_no()) {
        sky_of(context).with_sun = *on;
    }
}

void read_sky(Values& values, DirectiveContext& context) {
    constexpr std::array<std::string_view, 3> kNames{"uniform", "clear", "overcast"};
    const auto chosen = values.choice(kNames);
    if (!chosen) {
        return;
    }
    if (*chosen == 0) {
        context.spec.has_uniform_sky = true;
        return;
    }
    sky_of(context).weather = *chosen == 1 ? Weather::clear : Weather::overcast;
}

void read_sky_file(Values& values, DirectiveContext& context) {
    const std::string name = values.rest();
    const auto text = file_text(name, values, context);
    if (!text) {
        return;
    }
    const std::string table = sky_file_numbers(*text);
    Values numbers(name, "sky", table, values.faults(), context.notices);
    context.spec.sky_table = read_sky_table(numbers);
    numbers.finish();
}

constexpr std::array kLightDirectives{
    DirectiveEntry{"local light model", Dialect::quasimc, read_model},
    DirectiveEntry{"reflectance model", Dialect::montecarlo, read_model},
    DirectiveEntry{"light source", Dialect::both, read_light},
    DirectiveEntry{"light source file", Dialect::both, read_light_file},
    DirectiveEntry{"location", Dialect::both, read_location},
    DirectiveEntry{"weather", Dialect::both, read_weather},
    DirectiveEntry{"growth period", Dialect::both, read_period},
    DirectiveEntry{"julian day", Dialect::both, read_day},
    DirectiveEntry{"direct sun", Dialect::both, read_sun},
    DirectiveEntry{"sky", Dialect::both, read_sky},
    DirectiveEntry{"sky file", Dialect::both, read_sky_file},
};

}  // namespace

std::span<const DirectiveEntry> light_directives() {
    return kLightDirectives;
}

}  // namespace quasimc

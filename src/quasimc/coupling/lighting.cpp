#include "quasimc/coupling/lighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace quasimc {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadians = kPi / 180;

/// Parallel light before it is scaled: what comes from where, relative.
struct LightPart {
    Vec3 to_light;  // z up
    double amount = 0;
};

/// Towards a place of the sky: azimuth from south to west, elevation by its sine; z up.
Vec3 towards(double azimuth, double sine) {
    const double cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
    return plant_orientation().inward({cosine * std::cos(azimuth), sine, cosine * std::sin(azimuth)});
}

/// A cell of a sky of equal angles: its middle, in the sense that the sine of the elevation is the
/// mean over the cell, and its solid angle.
LightPart cell_of(const SkyTable& table, std::size_t azimuth, std::size_t elevation) {
    const double height = 0.5 * kPi / static_cast<double>(table.elevations);
    const double width = 2 * kPi / static_cast<double>(table.azimuths);
    const double low = std::sin(height * static_cast<double>(elevation));
    const double high = std::sin(height * static_cast<double>(elevation + 1));
    const double middle = -kPi + width * (static_cast<double>(azimuth) + 0.5);
    return {towards(middle, 0.5 * (low + high)), width * (high - low)};
}

/// The light of all cells: radiance times solid angle.
void add_cells(const SkyTable& table, std::vector<LightPart>& parts) {
    for (std::size_t a = 0; a < table.azimuths; ++a) {
        for (std::size_t e = 0; e < table.elevations; ++e) {
            LightPart cell = cell_of(table, a, e);
            cell.amount *= table.radiance[a * table.elevations + e];
            if (cell.amount > 0) {
                parts.push_back(cell);
            }
        }
    }
}

/// Luminance of the zenith and of the sky are in kcd/m2 (CIE 110-1994).
double clear_zenith(double elevation, double turbidity) {
    constexpr double kHighest = 0.99 * kPi / 2;  // the formula has no bound for a sun overhead
    return (1.376 * turbidity - 1.81) * std::tan(std::min(elevation, kHighest)) + 0.38;
}

double clear_luminance(const SunPlace& sun, double turbidity, const Vec3& to_sky) {
    const auto indicatrix = [](double angle) {
        const double cosine = std::cos(angle);
        return 0.91 + 10 * std::exp(-3 * angle) + 0.45 * cosine * cosine;
    };
    const double from_sun = std::acos(std::clamp(dot(sun.to_sun, to_sky), -1.0, 1.0));
    const double gradation = 1 - std::exp(-0.32 / to_sky.z);
    const double at_zenith = 1 - std::exp(-0.32);
    return clear_zenith(sun.elevation, turbidity) * indicatrix(from_sun) * gradation /
           (indicatrix(0.5 * kPi - sun.elevation) * at_zenith);
}

double overcast_luminance(const SunPlace& sun, const Vec3& to_sky) {
    return (8.6 * std::sin(sun.elevation) + 0.123) * (1 + 2 * to_sky.z) / 3;
}

/// Illuminance of the sun on a plane facing it, klx: 133.8 klx outside the atmosphere, luminous
/// extinction after Navvab et al. (1984), air mass after Kasten and Young (1989).
double beam_illuminance(const SunPlace& sun, double turbidity) {
    const double degrees = sun.elevation / kRadians;
    const double air_mass =
        1 / (std::sin(sun.elevation) + 0.50572 * std::pow(degrees + 6.07995, -1.6364));
    return 133.8 * std::exp(-turbidity * air_mass / (9.9 + 0.043 * air_mass));
}

/// Sky and sun of a part of a day, every six minutes.
std::vector<LightPart> parts_of_day(const SkyOfDay& sky) {
    constexpr std::size_t kCells = 32;
    SkyTable table{kCells, kCells, std::vector<double>(kCells * kCells)};
    std::vector<Vec3> cells;
    for (std::size_t i = 0; i < table.radiance.size(); ++i) {
        cells.push_back(cell_of(table, i / kCells, i % kCells).to_light);
    }
    std::vector<LightPart> parts;
    constexpr double kStepsPerHour = 10;
    const int steps =
        static_cast<int>(std::floor((sky.until_hour - sky.from_hour) * kStepsPerHour + 0.5));
    for (int i = 0; i <= steps; ++i) {
        const SunPlace sun = sun_place(sky, sky.from_hour + i / kStepsPerHour);
        if (sun.elevation <= 0) {
            continue;
        }
        const bool clear = sky.weather == Weather::clear;
        for (std::size_t c = 0; c < cells.size(); ++c) {
            table.radiance[c] += clear ? clear_luminance(sun, sky.turbidity, cells[c])
                                       : overcast_luminance(sun, cells[c]);
        }
        if (clear && sky.with_sun) {
            parts.push_back({sun.to_sun, beam_illuminance(sun, sky.turbidity)});
        }
    }
    add_cells(table, parts);
    return parts;
}

std::vector<LightPart> parts_of(const Specification& spec, const std::optional<SkyOfDay>& sky) {
    std::vector<LightPart> parts;
    if (!spec.lights.empty()) {
        for (const StatedLight& light : spec.lights) {
            const Vec3 travel = plant_orientation().inward(light.travel);
            parts.push_back({-normalized(travel), light.weight});
        }
    } else if (spec.sky_table) {
        add_cells(*spec.sky_table, parts);
    } else if (spec.has_uniform_sky) {
        constexpr std::size_t kAzimuths = 24, kElevations = 12;
        add_cells(
            {kAzimuths, kElevations, std::vector<double>(kAzimuths * kElevations, 1)}, parts);
    } else if (sky) {
        parts = parts_of_day(*sky);
    }
    std::erase_if(parts, [](const LightPart& part) { return !(part.amount > 0); });
    return parts;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
    for (double& value : values) {
        value *= factor;
    }
    return values;
}

}  // namespace

Orientation plant_orientation() {
    return {UpAxis::y, {-1, 0, 0}};
}

double Lighting::on_horizontal() const {
    double sum = 0;
    for (const LightShare& light : shares) {
        sum += light.share * std::abs(light.travel.z);
    }
    return sum;
}

namespace {

/// The sources of the bands of which these are the irradiances.
Sources sources_of(
    const Specification& spec,
    const std::vector<LightShare>& shares,
    const std::vector<double>& irradiance) {
    Sources sources;
    const bool is_uniform = spec.lights.empty() && !spec.sky_table && spec.has_uniform_sky;
    if (is_uniform) {
        // The sum over all directions is twice what falls on the horizontal.
        sources.push_back(make_uniform_sky("sky", scaled(irradiance, 0.5)));
        return sources;
    }
    for (const LightShare& light : shares) {
        sources.push_back(
            make_directional_source("light", light.travel, scaled(irradiance, light.share)));
    }
    return sources;
}

}  // namespace

Lighting make_lighting(const Specification& spec, const std::optional<SkyOfDay>& sky) {
    const std::vector<LightPart> parts = parts_of(spec, sky);
    const double total = std::accumulate(
        parts.begin(), parts.end(), 0.0, [](double sum, const LightPart& part) { return sum + part.amount; });
    Lighting lighting;
    for (const LightPart& part : parts) {
        lighting.shares.push_back({-part.to_light, part.amount / total});
    }
    if (spec.one_ray_per_spectrum) {
        lighting.sources.push_back(sources_of(spec, lighting.shares, spec.irradiance));
        return lighting;
    }
    for (const double irradiance : spec.irradiance) {
        lighting.sources.push_back(sources_of(spec, lighting.shares, {irradiance}));
    }
    return lighting;
}

SunPlace sun_place(const SkyOfDay& sky, double hour) {
    const double declination = 0.4093 * std::sin(2 * kPi * (sky.day - 81) / 368);
    const double equation_of_time = 0.17 * std::sin(4 * kPi * (sky.day - 80) / 373) -
                                    0.129 * std::sin(2 * kPi * (sky.day - 8) / 355);
    constexpr double kDegreesPerHour = 15;
    const double meridian = kDegreesPerHour * std::round(sky.longitude_deg / kDegreesPerHour);
    const double solar_time =
        hour + equation_of_time + (sky.longitude_deg - meridian) / kDegreesPerHour;
    const double latitude = sky.latitude_deg * kRadians;
    const double hour_angle = kPi * solar_time / 12;  // pi at noon
    const double sine = std::sin(latitude) * std::sin(declination) -
                        std::cos(latitude) * std::cos(declination) * std::cos(hour_angle);
    const double azimuth = -std::atan2(
        std::cos(declination) * std::sin(hour_angle),
        -std::cos(latitude) * std::sin(declination) -
            std::sin(latitude) * std::cos(declination) * std::cos(hour_angle));
    return {towards(azimuth, sine), std::asin(std::clamp(sine, -1.0, 1.0))};
}

}  // namespace quasimc

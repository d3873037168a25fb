#include "coupling/lighting.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/angles.h"
#include "light/daylight/clear_sky.h"
#include "quasimc/source.h"

namespace quasimc {
namespace {

/// A cell of a sky: its centre, at the mean sine of the elevation over the cell, and its solid
/// angle.
struct SkyCell {
    Vec3 to_light;  ///< z up
    double solid_angle = 0;
};

SkyCell cell_of(const SkyTable& table, std::size_t azimuth, std::size_t elevation) {
    const double height = 0.5 * kPi / static_cast<double>(table.elevations);
    const double width = 2 * kPi / static_cast<double>(table.azimuths);
    const double low = std::sin(height * static_cast<double>(elevation));
    const double high = std::sin(height * static_cast<double>(elevation + 1));
    const double around =
        table.first_azimuth + table.turn * width * (static_cast<double>(azimuth) + 0.5);
    const double sine = 0.5 * (low + high);
    const double cosine = std::sqrt(1 - sine * sine);
    return {{cosine * std::cos(around), cosine * std::sin(around), sine}, width * (high - low)};
}

/// The sky of a table and the suns beside it, in one unit.
struct DayLight {
    SkyTable table;
    std::vector<LightShare> suns;  // shares not normalized
};

/// Direction to the sun: unit vector, z up.
Vec3 to_sun_at(const SkyOfDay& sky, double hour) {
    const SimpleSun sun = simple_sun_position(
        sky.latitude_deg, sky.longitude_deg, sky.day, hour, nautical_utc_offset(sky.longitude_deg));
    return plant_orientation().towards(sun.azimuth_deg, sun.elevation_deg);
}

/// Luminance of the zenith, kcd/m2: clear skies after Dogniaux, as in the original program;
/// overcast skies after Krochmann.
double zenith_luminance(const SkyOfDay& sky, const Vec3& to_sun) {
    const double elevation = std::asin(std::clamp(to_sun.z, -1.0, 1.0));
    if (sky.weather == Weather::overcast) {
        return 8.6 * to_sun.z + 0.123;
    }
    constexpr double kHighest = 0.99 * kPi / 2;  // the formula has no bound for a sun overhead
    return (1.376 * sky.turbidity - 1.81) * std::tan(std::min(elevation, kHighest)) + 0.38;
}

/// Illuminance of the sun on a plane facing it, klx: 133.8 klx outside the atmosphere, luminous
/// extinction after Navvab et al. (1984), air mass after Kasten and Young (1989).
double beam_illuminance(const Vec3& to_sun, double turbidity) {
    const double degrees = std::asin(std::clamp(to_sun.z, -1.0, 1.0)) / kRadians;
    const double air_mass = relative_air_mass(degrees, to_sun.z);
    return 133.8 * std::exp(-turbidity * air_mass / (9.9 + 0.043 * air_mass));
}

/// Adds the sky at one time to the cells of a table.
void add_sun_and_sky(const SkyOfDay& sky, const Vec3& to_sun, DayLight& light) {
    const SkyShape shape =
        sky.weather == Weather::clear ? cie_clear_shape(to_sun) : cie_overcast_shape();
    const double scale = zenith_luminance(sky, to_sun) / shape.radiance({0, 0, 1});
    SkyTable& table = light.table;
    for (std::size_t e = 0; e < table.elevations; ++e) {
        for (std::size_t a = 0; a < table.azimuths; ++a) {
            table.radiance[e * table.azimuths + a] +=
                scale * shape.radiance(cell_of(table, a, e).to_light);
        }
    }
    if (sky.weather == Weather::clear && sky.with_sun) {
        light.suns.push_back({-to_sun, beam_illuminance(to_sun, sky.turbidity)});
    }
}

/// Sky and sun of a part of a day, sampled every six minutes.
DayLight light_of_day(const SkyOfDay& sky) {
    constexpr std::size_t kAzimuths = 48, kElevations = 24;
    constexpr double kStepsPerHour = 10;
    DayLight light{plant_sky_table(kAzimuths, kElevations), {}};
    const int steps =
        static_cast<int>(std::floor((sky.until_hour - sky.from_hour) * kStepsPerHour + 0.5));
    for (int i = 0; i <= steps; ++i) {
        const Vec3 to_sun = to_sun_at(sky, sky.from_hour + i / kStepsPerHour);
        if (to_sun.z > 0) {
            add_sun_and_sky(sky, to_sun, light);
        }
    }
    return light;
}

DayLight light_of(const Specification& spec, const std::optional<SkyOfDay>& sky) {
    if (!spec.lights.empty()) {
        DayLight light;
        for (const LightDirective& given : spec.lights) {
            const Vec3 travel = plant_orientation().inward(given.travel);
            light.suns.push_back({normalized(travel), given.weight});
        }
        return light;
    }
    if (spec.sky_table) {
        return {*spec.sky_table, {}};
    }
    if (spec.has_uniform_sky || !sky) {
        constexpr std::size_t kAzimuths = 24, kElevations = 12;
        SkyTable table = plant_sky_table(kAzimuths, kElevations);
        std::fill(table.radiance.begin(), table.radiance.end(), 1.0);
        return {std::move(table), {}};
    }
    return light_of_day(*sky);
}

/// The light of a day in parts that add up to 1.
struct SharedLight {
    SkyTable table;
    std::vector<LightShare> suns, cells;
    double sky = 0;                ///< share of the sky in the irradiance of all sources
    double sky_on_horizontal = 0;  ///< irradiance of the horizontal over that of the sky
};

SharedLight share_out(DayLight light) {
    SharedLight shared{std::move(light.table), std::move(light.suns), {}, 0, 0};
    double total = 0;
    for (std::size_t e = 0; e < shared.table.elevations; ++e) {
        for (std::size_t a = 0; a < shared.table.azimuths; ++a) {
            const SkyCell cell = cell_of(shared.table, a, e);
            const double amount = cell.solid_angle * shared.table.at(a, e);
            shared.cells.push_back({-cell.to_light, amount});
            shared.sky += amount;
            shared.sky_on_horizontal += amount * cell.to_light.z;
        }
    }
    total = shared.sky;
    std::erase_if(shared.suns, [](const LightShare& sun) { return !(sun.share > 0); });
    for (const LightShare& sun : shared.suns) {
        total += sun.share;
    }
    if (total > 0) {
        for (auto* list : {&shared.suns, &shared.cells}) {
            for (LightShare& part : *list) {
                part.share /= total;
            }
        }
        shared.sky /= total;
        shared.sky_on_horizontal /= total;
    }
    std::erase_if(shared.cells, [](const LightShare& cell) { return !(cell.share > 0); });
    return shared;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
    for (double& value : values) {
        value *= factor;
    }
    return values;
}

/// Sources for the given irradiances, one per band.
Sources sources_of(const SharedLight& light, const std::vector<double>& irradiance) {
    Sources sources;
    if (light.sky > 0) {
        sources.push_back(
            make_sky("sky", table_shape(light.table), scaled(irradiance, light.sky_on_horizontal)));
    }
    for (const LightShare& sun : light.suns) {
        sources.push_back(
            make_directional_source("light", sun.travel, scaled(irradiance, sun.share)));
    }
    return sources;
}

}  // namespace

Orientation plant_orientation() {
    return {UpAxis::y, {-1, 0, 0}};
}

SkyTable plant_sky_table(std::size_t azimuths, std::size_t elevations) {
    // South is +y here and west +x: the azimuths run from south to west, against x towards y.
    return {azimuths, elevations, std::vector<double>(azimuths * elevations), 1.5 * kPi, -1};
}

double Lighting::on_horizontal() const {
    double sum = 0;
    for (const LightShare& light : shares) {
        sum += light.share * std::abs(light.travel.z);
    }
    return sum;
}

Lighting make_lighting(const Specification& spec, const std::optional<SkyOfDay>& sky) {
    const SharedLight light = share_out(light_of(spec, sky));
    Lighting lighting;
    lighting.shares = light.suns;
    lighting.shares.insert(lighting.shares.end(), light.cells.begin(), light.cells.end());
    if (spec.one_ray_per_spectrum) {
        lighting.sources.push_back(sources_of(light, spec.irradiance));
        return lighting;
    }
    for (const double irradiance : spec.irradiance) {
        lighting.sources.push_back(sources_of(light, {irradiance}));
    }
    return lighting;
}

}  // namespace quasimc

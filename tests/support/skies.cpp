#include "support/skies.h"

#include <array>
#include <cmath>
#include <numbers>

namespace quasimc::test {
namespace {

/// Diffuse and direct light in each of the eight ranges of clearness, W m-2.
constexpr std::array<std::array<double, 2>, 8> kWeather{
    {{150, 0}, {250, 40}, {300, 120}, {300, 250}, {250, 400}, {180, 600}, {110, 700}, {70, 880}}};

/// The states under which a row of the catalogue is tested.
std::vector<SkyState> states_of(const SkyEntry& entry, double elevation_deg) {
    SkyState state;
    state.to_sun = sun_at(elevation_deg);
    std::vector<SkyState> states;
    switch (entry.needs) {
        case SkyNeeds::sun_and_type:
            for (state.cie_type = 1; state.cie_type <= 15; ++state.cie_type) {
                states.push_back(state);
            }
            return states;
        case SkyNeeds::sun_and_turbidity:
            for (const double turbidity : {kLowestTurbidity, 3.0, kHighestTurbidity}) {
                state.turbidity = turbidity;
                states.push_back(state);
            }
            return states;
        case SkyNeeds::sun_and_weather:
            for (const auto& [diffuse, direct] : kWeather) {
                state.diffuse_horizontal = diffuse;
                state.direct_normal = direct;
                states.push_back(state);
            }
            return states;
        default:
            return {state};
    }
}

SkyShape sum_of_a_day() {
    SkySum sum(48, 24);
    for (const double elevation : {10.0, 40.0, 70.0}) {
        sum.add_sky(cie_clear_shape(sun_at(elevation)), elevation);
    }
    sum.add_sky(cie_overcast_shape(), 20);
    return table_shape(sum.table());
}

}  // namespace

Vec3 sun_at(double elevation_deg) {
    const double elevation = elevation_deg * std::numbers::pi / 180;
    const double flat = std::cos(elevation);
    return {.6 * flat, .8 * flat, std::sin(elevation)};
}

SkyTable uneven_table(std::size_t azimuths, std::size_t elevations) {
    SkyTable table{azimuths, elevations, {}, .3, -1};
    for (std::size_t i = 0; i < azimuths * elevations; ++i) {
        table.radiance.push_back(static_cast<double>((i * 7) % 11));
    }
    return table;
}

std::vector<NamedSky> all_skies() {
    std::vector<NamedSky> skies;
    for (const SkyEntry& entry : sky_catalogue()) {
        for (const double elevation : {65.0, 8.0}) {
            const std::vector<SkyState> states = states_of(entry, elevation);
            for (std::size_t i = 0; i < states.size(); ++i) {
                skies.push_back(
                    {std::string(entry.name) + (elevation > 45 ? "_high_" : "_low_") +
                         std::to_string(i + 1),
                     entry.make(states[i])});
            }
        }
    }
    skies.push_back({"table_small", table_shape(uneven_table(3, 2))});
    skies.push_back({"table_original", table_shape(uneven_table(32, 32))});
    skies.push_back({"table_large", table_shape(uneven_table(90, 45))});
    skies.push_back({"sum", sum_of_a_day()});
    return skies;
}

std::vector<std::shared_ptr<const Source>> sample_of_skies(const std::vector<double>& spectrum) {
    std::vector<std::shared_ptr<const Source>> sources;
    for (const SkyEntry& entry : sky_catalogue()) {
        sources.push_back(
            make_sky(std::string(entry.name), entry.make(states_of(entry, 35).back()), spectrum));
    }
    sources.push_back(make_sky("table", table_shape(uneven_table(5, 4)), spectrum));
    sources.push_back(make_sky("sum", sum_of_a_day(), spectrum));
    sources.push_back(make_sun_disk("disk of the sun", sun_at(40), 5, spectrum));
    return sources;
}

}  // namespace quasimc::test

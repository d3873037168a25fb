#include "io/results/window_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <nlohmann/json.hpp>

#include "base/vec3.h"
#include "io/results/json_parts.h"

namespace quasimc {
namespace {

constexpr int kRings = 9, kSectors = 36;

bool is_sky(const Source& source) {
    return source.traits().at_infinity && source.traits().extended;
}

/// Radiances of all skies together, of all bands, by cells.
std::vector<double> sky_cells(const Sources& sources) {
    std::vector<double> cells(std::size_t{kRings} * kSectors);
    for (const auto& source : sources) {
        if (!is_sky(*source)) {
            continue;
        }
        const auto spectrum = source->spectrum();
        const double all = std::accumulate(spectrum.begin(), spectrum.end(), 0.0);
        for (int i = 0; i < kRings * kSectors; ++i) {
            const int ring = i / kSectors, sector = i % kSectors;
            const double elevation = (ring + 0.5) * std::numbers::pi / 2 / kRings;
            const double azimuth = (sector + 0.5) * 2 * std::numbers::pi / kSectors;
            cells[static_cast<std::size_t>(i)] +=
                all * source->radiance(
                          {std::cos(elevation) * std::cos(azimuth),
                           std::cos(elevation) * std::sin(azimuth), std::sin(elevation)});
        }
    }
    return cells;
}

std::string sky_digits(const std::vector<double>& cells) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const double most = *std::max_element(cells.begin(), cells.end());
    if (!(most > 0)) {
        return {};
    }
    std::string digits;
    for (const double cell : cells) {
        const double part = std::sqrt(std::clamp(cell / most, 0.0, 1.0));
        digits += kDigits[static_cast<std::size_t>(std::lround(part * 63))];
    }
    return digits;
}

}  // namespace

WindowLights window_lights(const Sources& sources) {
    WindowLights lights;
    for (const auto& source : sources) {
        if (source->is_sun()) {
            lights.suns.push_back(source->illuminate({}, 0.5, 0.5).to_light);
        } else if (source->is_lamp()) {
            const Illumination seen = source->illuminate({}, 0.5, 0.5);
            lights.lamps.push_back(seen.distance * seen.to_light);
        }
    }
    lights.sky = sky_digits(sky_cells(sources));
    return lights;
}

Json json_lights(const WindowLights& lights, const Vec3& middle) {
    Json suns = Json::array(), lamps = Json::array();
    for (const Vec3& sun : lights.suns) {
        suns.push_back(json_vector(sun));
    }
    for (const Vec3& lamp : lights.lamps) {
        lamps.push_back(json_vector(lamp - middle));
    }
    return {{"suns", suns}, {"lamps", lamps}, {"sky", lights.sky}};
}

}  // namespace quasimc

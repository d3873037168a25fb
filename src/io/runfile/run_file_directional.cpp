#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/runfile/run_file_source_kinds.h"

namespace quasimc {
namespace {

/// The unit vector in which light travels, z up; nothing after a fault.
std::optional<Vec3> read_travel(TableReader& table, const Orientation& orientation) {
    const bool has_direction = table.any("direction") != nullptr;
    // Each is looked at, or a fault below would leave the other a key that nobody knows.
    const bool has_azimuth = table.any("azimuth_deg") != nullptr;
    const bool has_elevation = table.any("elevation_deg") != nullptr;
    const bool has_angles = has_azimuth || has_elevation;
    if (has_direction == has_angles) {
        table.fault(
            has_direction ? "direction and angles are given" : "where it shines from is missing",
            "",
            "give either direction = [x, y, z], in which the light travels, or azimuth_deg and "
            "elevation_deg of where it comes from");
        return std::nullopt;
    }
    if (has_angles) {
        const auto elevation =
            table.required("elevation_deg", table.real("elevation_deg", {-90, 90}));
        const auto azimuth = table.required("azimuth_deg", table.real("azimuth_deg", {-360, 360}));
        return elevation && azimuth ? std::optional(-orientation.towards(*azimuth, *elevation))
                                    : std::nullopt;
    }
    const std::optional<Vec3> direction = table.vector("direction");
    if (!direction) {
        return std::nullopt;
    }
    // Scaled first: the square of a very long or short vector is no number.
    const double size =
        std::max({std::abs(direction->x), std::abs(direction->y), std::abs(direction->z)});
    if (size == 0) {
        table.fault_at("direction", "direction is [0, 0, 0]", "it points nowhere");
        return std::nullopt;
    }
    return normalized(orientation.inward(*direction / size));
}

}  // namespace

std::optional<NotedSource> read_directional(
    TableReader& table, const std::string& name, const RunFileContext& context) {
    const std::optional<Vec3> travel = read_travel(table, context.orientation);
    const std::optional<Irradiance> irradiance = read_irradiance(table, context.bands);
    if (!travel || !irradiance) {
        return std::nullopt;
    }
    const auto values = facing_irradiance(table, *irradiance, -travel->z);
    if (!values) {
        return std::nullopt;
    }
    if (travel->z > 0) {
        table.reporter().warnings.push_back(
            {table.place(), table.what() + ": it shines upwards, from below the horizon"});
    }
    const std::string note = fmt::format(
        "{}: directional, light travels along {} (from {}), {}", name,
        vector_words(context.orientation.outward(*travel)),
        angles_words(*travel, context.orientation),
        irradiance_words("plane facing it", *values, context.bands));
    return NotedSource{make_directional_source(name, *travel, *values), note};
}

}  // namespace quasimc

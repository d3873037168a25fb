#include <fmt/format.h>

#include "runfile/run_file_source_kinds.h"

namespace quasimc {
namespace {

/// The unit vector of travel, z up; empty after a fault.
std::optional<Vec3> read_travel(TableReader& table, const RunFileContext& context) {
    const bool has_direction = table.any("direction") != nullptr;
    // Both keys are read, so that a fault below does not make the other an unknown key.
    const bool has_azimuth = table.any("azimuth_deg") != nullptr;
    const bool has_elevation = table.any("elevation_deg") != nullptr;
    const bool has_angles = has_azimuth || has_elevation;
    if (has_direction == has_angles) {
        table.fault(
            has_direction ? "both direction and angles are given" : "its direction is missing", "",
            "give direction = [x, y, z] in which the light travels, or azimuth_deg and "
            "elevation_deg towards the source");
        return std::nullopt;
    }
    if (has_angles) {
        const auto to_light = read_towards(table, context.orientation);
        return to_light ? std::optional(-*to_light) : std::nullopt;
    }
    return read_direction(table, "direction", std::nullopt, context);
}

}  // namespace

std::optional<NotedSource> read_directional(
    TableReader& table, const std::string& name, const RunFileContext& context) {
    const std::optional<Vec3> travel = read_travel(table, context);
    const std::optional<Irradiance> irradiance = read_irradiance(table, context.bands);
    if (!travel || !irradiance) {
        return std::nullopt;
    }
    const auto values = facing_irradiance(table, *irradiance, -travel->z);
    if (!values) {
        return std::nullopt;
    }
    if (travel->z > 0) {
        table.warn(table.what() + ": it is below the horizon");
    }
    const std::string note = fmt::format(
        "{}: {}; {}", name, format_angles(*travel, context.orientation),
        format_irradiance("a plane facing it", *values, context.bands));
    return NotedSource{make_directional_source(name, *travel, *values), note};
}

}  // namespace quasimc

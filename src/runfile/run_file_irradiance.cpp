#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/text.h"
#include "runfile/run_file_source_kinds.h"
#include "text/numbers.h"

namespace quasimc {

std::string format_irradiance(
    std::string_view plane, const std::vector<double>& values, const std::vector<Band>& bands) {
    std::string text;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        text += fmt::format(
            "{}{} {} {}", b == 0 ? "" : ", ", bands[b].name, shortest(values[b]), bands[b].unit);
    }
    return fmt::format("{} on {}", text, plane);
}

std::string format_vector(const Vec3& v) {
    return fmt::format(
        "({:.6g}, {:.6g}, {:.6g})", without_rounding(v.x), without_rounding(v.y),
        without_rounding(v.z));
}

std::string format_angles(const Vec3& travel, const Orientation& orientation) {
    const Vec3 north = normalized(orientation.inward(orientation.north()));
    const Vec3 east{north.y, -north.x, 0};
    const Vec3 to_sun = -travel;
    const double elevation = 180 / std::numbers::pi * std::asin(std::clamp(to_sun.z, -1.0, 1.0));
    double azimuth = 180 / std::numbers::pi * std::atan2(dot(to_sun, east), dot(to_sun, north));
    azimuth += azimuth < 0 ? 360 : 0;
    const bool overhead = std::hypot(to_sun.x, to_sun.y) < 1e-12;
    return fmt::format(
        "azimuth {:.6g} deg, elevation {:.6g} deg", overhead ? 0 : azimuth, elevation);
}

std::optional<Irradiance> read_irradiance(TableReader& table, const std::vector<Band>& bands) {
    const auto facing = read_irradiances(table, "irradiance_facing", bands);
    const auto horizontal = read_irradiances(table, "irradiance_horizontal", bands);
    const bool has_facing = table.any("irradiance_facing") != nullptr;
    const bool has_horizontal = table.any("irradiance_horizontal") != nullptr;
    if (has_facing == has_horizontal) {
        table.fault(
            has_facing ? "two irradiances are given" : "its irradiance is missing", "",
            "give irradiance_facing (on a plane that faces it) or irradiance_horizontal");
        return std::nullopt;
    }
    const auto& values = has_facing ? facing : horizontal;
    return values ? std::optional(Irradiance{*values, has_horizontal}) : std::nullopt;
}

std::optional<std::vector<double>> facing_irradiance(
    TableReader& table, Irradiance irradiance, double sine) {
    if (!irradiance.on_horizontal) {
        return irradiance.values;
    }
    constexpr double kHorizon = 1e-6;
    if (sine < kHorizon) {
        table.fault_at(
            "irradiance_horizontal", "irradiance_horizontal of a source below the horizon",
            "its light does not reach the horizontal from above", "give irradiance_facing");
        return std::nullopt;
    }
    for (double& value : irradiance.values) {
        value /= sine;
    }
    return irradiance.values;
}

}  // namespace quasimc

#include <fmt/format.h>

#include "base/text.h"
#include "quasimc/source.h"
#include "runfile/run_file_sections.h"
#include "runfile/run_file_source_kinds.h"
#include "weather/civil_time_text.h"

namespace quasimc {
namespace {

std::optional<SunSpec> read_timed_sun(TableReader& table, const RunFileContext& context) {
    const auto delta_t_s = table.real("delta_t_s", {-1e6, 1e6});
    const std::optional<std::string> text = table.time_text("time");
    if (!context.site) {
        const std::string site = table.table_name("site");
        table.fault_at(
            "time", "time without " + site, "the sun's position depends on the site",
            fmt::format("add {} with latitude_deg and longitude_deg", site));
        return std::nullopt;
    }
    if (!text) {
        return std::nullopt;
    }
    Faults faults;
    const std::string where =
        fmt::format("{}: {}: time", table.reporter().where(table.any("time")->line), table.what());
    const auto time = parse_civil_time(*text, std::nullopt, where, faults, OffsetKey::none);
    if (!time) {
        table.reporter().faults.add(faults);
        return std::nullopt;
    }
    const SunPosition sun = sun_position(*context.site, *time, delta_t_s);
    const std::string description = fmt::format(
        "{} at latitude {}, longitude {}", civil_time_text(*time),
        shortest(context.site->latitude_deg), shortest(context.site->longitude_deg));
    return SunSpec{
        context.orientation.towards(sun.azimuth_deg, sun.elevation_deg), sun.distance_au,
        description};
}

}  // namespace

std::optional<Vec3> read_towards(TableReader& table, const Orientation& orientation) {
    const auto elevation = table.required("elevation_deg", table.real("elevation_deg", {-90, 90}));
    const auto azimuth = table.required("azimuth_deg", table.real("azimuth_deg", {-360, 360}));
    return elevation && azimuth ? std::optional(orientation.towards(*azimuth, *elevation))
                                : std::nullopt;
}

std::optional<SunSpec> read_sun_spec(TableReader& table, const RunFileContext& context) {
    const bool has_time = table.any("time") != nullptr;
    const bool has_angles =
        table.any("azimuth_deg") != nullptr || table.any("elevation_deg") != nullptr;
    if (has_time && has_angles) {
        table.fault(
            "both time and angles are given", "each of them gives the position of the sun",
            "remove one of them");
        return std::nullopt;
    }
    if (has_time) {
        return read_timed_sun(table, context);
    }
    if (!has_angles) {
        table.fault(
            "the position of the sun is missing", "",
            fmt::format(
                "give time (with {}), or azimuth_deg and elevation_deg", table.table_name("site")));
        return std::nullopt;
    }
    const auto to_sun = read_towards(table, context.orientation);
    return to_sun ? std::optional(SunSpec{*to_sun, 1, ""}) : std::nullopt;
}

std::string describe_sun(const SunSpec& sun, const Orientation& orientation) {
    return format_angles(-sun.to_sun, orientation) +
           (sun.description.empty() ? "" : fmt::format(" ({})", sun.description));
}

std::optional<NotedSource> read_sun(
    TableReader& table, const std::string& name, const RunFileContext& context) {
    const std::optional<SunSpec> sun = read_sun_spec(table, context);
    const bool is_disk = table.boolean("disk").value_or(false);
    std::optional<Irradiance> irradiance = read_irradiance(table, context.bands);
    if (!sun || !irradiance) {
        return std::nullopt;
    }
    const bool is_down = sun->to_sun.z <= 0;
    if (is_down) {
        table.warn(fmt::format(
            "{}: the sun is below the horizon and gives no light ({})", table.what(),
            format_angles(-sun->to_sun, context.orientation)));
        irradiance = Irradiance{std::vector<double>(context.bands.size(), 0.0), false};
    }
    const auto values = facing_irradiance(table, *irradiance, sun->to_sun.z);
    if (!values) {
        return std::nullopt;
    }
    const std::string note = fmt::format(
        "{}: {}{}; {}", name, describe_sun(*sun, context.orientation),
        is_disk ? fmt::format("; disk of radius {:.4g} deg", solar_radius_deg(sun->distance_au))
                : "",
        format_irradiance("a plane facing it", *values, context.bands));
    NotedSource noted{nullptr, note, sun};
    noted.source =
        is_disk ? make_sun_disk(name, sun->to_sun, solar_radius_deg(sun->distance_au), *values)
                : make_directional_source(name, -sun->to_sun, *values);
    return noted;
}

std::optional<Site> read_site(TableReader& top) {
    const Node* node = top.any("site");
    if (node == nullptr) {
        return std::nullopt;
    }
    TableReader table(*node, top.table_name("site"), top.reporter());
    Site site;
    const auto latitude = table.required("latitude_deg", table.real("latitude_deg", {-90, 90}));
    const auto longitude =
        table.required("longitude_deg", table.real("longitude_deg", {-180, 180}));
    site.latitude_deg = latitude.value_or(0);
    site.longitude_deg = longitude.value_or(0);
    site.elevation_m = table.real("elevation_m", {-2000, 11000}).value_or(0);
    site.pressure_hpa =
        table.real("pressure_hpa", {0, 2000}).value_or(standard_pressure_hpa(site.elevation_m));
    site.temperature_c = table.real("temperature_c", {-100, 100}).value_or(Site{}.temperature_c);
    table.finish();
    return table.failed() ? std::nullopt : std::optional(site);
}

}  // namespace quasimc

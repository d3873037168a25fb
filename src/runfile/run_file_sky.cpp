#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "quasimc/source.h"
#include "runfile/run_file_source_kinds.h"
#include "weather/read_sky_table.h"

namespace quasimc {
namespace {

/// The model that is read from a file.
constexpr std::string_view kTable = "table";

std::vector<std::string_view> model_names() {
    std::vector<std::string_view> names = names_in(sky_catalogue());
    names.push_back(kTable);
    return names;
}

/// Reads the shape of a sky with model = "table"; empty after a fault.
std::optional<SkyShapeSpec> read_table_shape(TableReader& table, const RunFileContext& context) {
    constexpr std::array<std::string_view, 2> kFormats{"cells", "vlab"};
    constexpr std::array<std::string_view, 2> kValues{"radiance", "flux"};
    const auto file = table.required("file", table.text("file"));
    const auto format = table.any("format") != nullptr ? table.choice("format", kFormats)
                                                       : std::optional<std::string>("cells");
    const auto values = table.any("values") != nullptr ? table.choice("values", kValues)
                                                       : std::optional<std::string>("radiance");
    if (!file || !format || !values) {
        return std::nullopt;
    }
    try {
        SkyTable sky = read_sky_table(
            context.files->read(*file), *file,
            *format == "vlab" ? SkyFileFormat::vlab : SkyFileFormat::cells,
            *values == "flux" ? SkyValues::flux : SkyValues::radiance);
        const Vec3 north = context.orientation.towards(0, 0);
        sky.first_azimuth = std::atan2(north.y, north.x);
        const std::string description = fmt::format(
            "sky of {} ({} x {} cells, values: {})", *file, sky.azimuths, sky.elevations, *values);
        return SkyShapeSpec{table_shape(std::move(sky)), description};
    } catch (const InputError& error) {
        table.reporter().faults.add(error);
        return std::nullopt;
    }
}

/// The sun of a sky: its own, or else the first sun in the file.
std::optional<SunSpec> read_sun_of_sky(TableReader& table, const RunFileContext& context) {
    const bool has_own = table.any("time") != nullptr || table.any("azimuth_deg") != nullptr ||
                         table.any("elevation_deg") != nullptr;
    if (has_own) {
        return read_sun_spec(table, context);
    }
    if (!context.sun) {
        table.fault(
            "the position of the sun is missing", "this sky model is brighter around the sun",
            fmt::format(
                "add a source of type \"sun\", or give time (with {}) or azimuth_deg and "
                "elevation_deg",
                table.table_name("site")));
    }
    return context.sun;
}

/// Reads the parameters of the model except the sun. Returns false after a fault.
bool read_state(TableReader& table, SkyNeeds needs, SkyState& state) {
    if (needs == SkyNeeds::sun_and_type) {
        const auto type = table.required("cie_type", table.integer("cie_type", {1, 15}));
        state.cie_type = static_cast<int>(type.value_or(state.cie_type));
        return type.has_value();
    }
    if (needs == SkyNeeds::sun_and_turbidity) {
        const auto turbidity = table.required(
            "turbidity", table.real("turbidity", {kLowestTurbidity, kHighestTurbidity}));
        state.turbidity = turbidity.value_or(state.turbidity);
        return turbidity.has_value();
    }
    if (needs == SkyNeeds::sun_and_weather) {
        const auto direct = table.required("direct_normal", table.real("direct_normal", {0, 2000}));
        const auto diffuse =
            table.required("diffuse_horizontal", table.real("diffuse_horizontal", {0, 2000}));
        state.direct_normal = direct.value_or(0);
        state.diffuse_horizontal = diffuse.value_or(0);
        return direct && diffuse;
    }
    return true;
}

std::string describe_state(SkyNeeds needs, const SkyState& state) {
    switch (needs) {
        case SkyNeeds::sun_and_type:
            return fmt::format(" (type {})", state.cie_type);
        case SkyNeeds::sun_and_turbidity:
            return fmt::format(" (turbidity {})", shortest(state.turbidity));
        case SkyNeeds::sun_and_weather:
            return fmt::format(
                " (direct normal {} W m-2, diffuse horizontal {} W m-2)",
                shortest(state.direct_normal), shortest(state.diffuse_horizontal));
        default:
            return "";
    }
}

std::optional<SkyShapeSpec> read_model(
    TableReader& table, const SkyEntry& entry, const RunFileContext& context) {
    SkyState state;
    std::string sun_text;
    bool good = read_state(table, entry.needs, state);
    if (entry.needs != SkyNeeds::nothing) {
        const std::optional<SunSpec> sun = read_sun_of_sky(table, context);
        if (sun && sun->to_sun.z <= 0) {
            table.fault(
                fmt::format(
                    "the sun is below the horizon ({})",
                    format_angles(-sun->to_sun, context.orientation)),
                fmt::format("{} describes daytime skies", entry.name),
                "use model = \"cie_overcast\" or \"uniform\"");
        }
        good = good && sun && sun->to_sun.z > 0;
        if (good) {
            state.to_sun = sun->to_sun;
            state.distance_au = sun->distance_au;
            sun_text = ", sun at " + describe_sun(*sun, context.orientation);
        }
    }
    if (!good) {
        return std::nullopt;
    }
    try {
        return SkyShapeSpec{
            entry.make(state),
            fmt::format("{} sky{}{}", entry.name, describe_state(entry.needs, state), sun_text)};
    } catch (const InputError& error) {
        for (const Fault& fault : error.faults()) {
            table.fault(fault.problem, fault.why, fault.suggestion);
        }
        return std::nullopt;
    }
}

}  // namespace

std::optional<NotedSource> read_sky(
    TableReader& table, const std::string& name, const RunFileContext& context) {
    const auto model = table.required("model", table.choice("model", model_names()));
    const auto values = table.required(
        "irradiance_horizontal", read_irradiances(table, "irradiance_horizontal", context.bands));
    if (!model) {
        // The model of the keys is unknown.
        for (const std::string_view key :
             {"time", "delta_t_s", "azimuth_deg", "elevation_deg", "cie_type", "turbidity",
              "direct_normal", "diffuse_horizontal", "file", "format", "values"}) {
            static_cast<void>(table.any(key));
        }
        return std::nullopt;
    }
    std::optional<SkyShapeSpec> sky;
    if (*model == kTable) {
        sky = read_table_shape(table, context);
    } else {
        sky = read_model(table, *find_sky(*model), context);
    }
    if (!sky || !values) {
        return std::nullopt;
    }
    const std::string note = fmt::format(
        "{}: {}; {}", name, sky->description,
        format_irradiance("the horizontal", *values, context.bands));
    // The special source of the uniform sky gives all paths equal weights.
    const bool is_uniform = *model == "uniform";
    return NotedSource{
        is_uniform ? make_uniform_sky(name, *values) : make_sky(name, sky->shape, *values),
        note,
        {}};
}

std::optional<NotedSource> read_uniform_sky(
    TableReader& table, const std::string& name, const RunFileContext& context) {
    const auto values = table.required(
        "irradiance_horizontal", read_irradiances(table, "irradiance_horizontal", context.bands));
    if (!values) {
        return std::nullopt;
    }
    return NotedSource{
        make_uniform_sky(name, *values),
        fmt::format(
            "{}: uniform sky; {}", name,
            format_irradiance("the horizontal", *values, context.bands))};
}

}  // namespace quasimc

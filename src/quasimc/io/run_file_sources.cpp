#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "quasimc/base/text.h"
#include "quasimc/io/run_file_sections.h"

namespace quasimc {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// A source with the words that tell it in a header.
struct NotedSource {
    std::shared_ptr<const Source> source;
    std::string note;
};

std::string irradiance_words(
    std::string_view plane, const std::vector<double>& values, const std::vector<Band>& bands) {
    std::string text = fmt::format("irradiance on the {}", plane);
    for (std::size_t b = 0; b < bands.size(); ++b) {
        text += fmt::format(
            "{} {} {} {}", b == 0 ? ":" : ",", bands[b].name, shortest(values[b]), bands[b].unit);
    }
    return text;
}

/// A unit vector; what is but rounding is 0.
std::string vector_words(const Vec3& v) {
    const auto shown = [](double x) { return std::abs(x) < 1e-12 ? 0.0 : x; };
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", shown(v.x), shown(v.y), shown(v.z));
}

/// The unit vector in which light travels, z up; nothing after a fault.
std::optional<Vec3> read_travel(TableReader& table, const Orientation& orientation) {
    const bool has_direction = table.any("direction") != nullptr;
    const bool has_angles =
        table.any("azimuth_deg") != nullptr || table.any("elevation_deg") != nullptr;
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

/// Where light that travels along `travel` comes from: azimuth from north over east, elevation.
std::string angles_words(const Vec3& travel, const Orientation& orientation) {
    const Vec3 north = normalized(orientation.inward(orientation.north()));
    const Vec3 east{north.y, -north.x, 0};
    const Vec3 to_sun = -travel;
    const double elevation = kDegrees * std::asin(std::clamp(to_sun.z, -1.0, 1.0));
    double azimuth = kDegrees * std::atan2(dot(to_sun, east), dot(to_sun, north));
    azimuth += azimuth < 0 ? 360 : 0;
    const bool overhead = std::hypot(to_sun.x, to_sun.y) < 1e-12;
    return fmt::format(
        "azimuth {:.6g} deg, elevation {:.6g} deg", overhead ? 0 : azimuth, elevation);
}

/// The irradiance of a source, on exactly one plane.
struct Irradiance {
    std::vector<double> values;
    bool on_horizontal = false;
};

std::optional<Irradiance> read_irradiance(TableReader& table, const std::vector<Band>& bands) {
    const auto facing = read_per_band(table, "irradiance_facing", bands, TableReader::kNotNegative);
    const auto horizontal =
        read_per_band(table, "irradiance_horizontal", bands, TableReader::kNotNegative);
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

/// On the plane facing light from `sine` = sin(elevation).
std::optional<std::vector<double>> facing(TableReader& table, Irradiance irradiance, double sine) {
    if (!irradiance.on_horizontal) {
        return irradiance.values;
    }
    constexpr double kHorizon = 1e-6;
    if (sine < kHorizon) {
        table.fault_at(
            "irradiance_horizontal",
            "irradiance_horizontal of a source that is not above the horizon",
            "light from there does not fall on the upper side of the horizontal",
            "give irradiance_facing");
        return std::nullopt;
    }
    for (double& value : irradiance.values) {
        value /= sine;
    }
    return irradiance.values;
}

std::optional<NotedSource> read_directional(
    TableReader& table, const std::string& name, const RunFileContext& context) {
    const std::optional<Vec3> travel = read_travel(table, context.orientation);
    const std::optional<Irradiance> irradiance = read_irradiance(table, context.bands);
    if (!travel || !irradiance) {
        return std::nullopt;
    }
    const auto values = facing(table, *irradiance, -travel->z);
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

std::optional<NotedSource> read_uniform_sky(
    TableReader& table, const std::string& name, const RunFileContext& context) {
    const auto values = table.required(
        "irradiance_horizontal",
        read_per_band(table, "irradiance_horizontal", context.bands, TableReader::kNotNegative));
    if (!values) {
        return std::nullopt;
    }
    const std::string note = fmt::format(
        "{}: uniform sky, {}", name, irradiance_words("horizontal", *values, context.bands));
    return NotedSource{make_uniform_sky(name, *values), note};
}

/// One row of the table of kinds of sources.
struct SourceKind {
    std::string_view name;
    std::optional<NotedSource> (*read)(
        TableReader& table, const std::string& name, const RunFileContext& context);
};

// To add a kind of source to the run file: a function as above, a row here, a section in
// docs/formats/run-file.md.
constexpr std::array kKinds{
    SourceKind{"directional", read_directional}, SourceKind{"uniform_sky", read_uniform_sky}};

std::optional<NotedSource> read_source(const Node& node, const RunFileContext& context) {
    std::array<std::string_view, kKinds.size()> names;
    std::transform(kKinds.begin(), kKinds.end(), names.begin(), [](const SourceKind& kind) {
        return kind.name;
    });
    TableReader table(node, "source", *context.reporter);
    const std::optional<std::string> type = table.required("type", table.choice("type", names));
    const std::string name = table.text("name").value_or(type.value_or("source"));
    table.rename(fmt::format("source '{}'", name));
    std::optional<NotedSource> source;
    if (!type) {
        return source;  // which keys are meant can't be told
    }
    for (const SourceKind& kind : kKinds) {
        if (kind.name == *type) {
            source = kind.read(table, name, context);
        }
    }
    table.finish();
    return source;
}

}  // namespace

SourceList read_sources(TableReader& top, const RunFileContext& context) {
    SourceList list;
    const std::vector<const Node*> tables = top.tables("source");
    for (const Node* node : tables) {
        if (std::optional<NotedSource> source = read_source(*node, context)) {
            list.sources.push_back(std::move(source->source));
            list.notes.push_back(std::move(source->note));
        }
    }
    if (tables.empty()) {
        top.fault("no source of light is given", "", "add a [[source]]");
    }
    return list;
}

}  // namespace quasimc

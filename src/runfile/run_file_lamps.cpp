#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/angles.h"
#include "base/length_units.h"
#include "base/text.h"
#include "quasimc/source.h"
#include "results/units.h"
#include "runfile/run_file_source_kinds.h"
#include "weather/read_ies.h"

namespace quasimc {
namespace {

constexpr Range kPositive{std::numeric_limits<double>::min(), TableReader::kFinite.high};

/// Keys for the flux of a lamp, with the corresponding unit of irradiance.
struct FluxKey {
    std::string_view key, unit, of_band;
};
constexpr std::array kFluxKeys{
    FluxKey{"power", "W", "W m-2"}, FluxKey{"photon_flux", "umol s-1", "umol m-2 s-1"},
    FluxKey{"luminous_flux", "lm", "lx"}};

/// Square metres per square unit of the scene; empty after a fault.
std::optional<double> square_metres(TableReader& table, const RunFileContext& context) {
    if (const auto metres = metres_per(context.length_unit)) {
        return *metres * *metres;
    }
    table.fault(
        fmt::format("length_unit is '{}'", context.length_unit),
        "the irradiance from a lamp depends on the size of the scene",
        "use m, cm, mm, dm, km, um, ft, in or yd");
    return std::nullopt;
}

/// Sets position and direction of a lamp. By default it aims down, with its x axis towards north.
bool read_pose(TableReader& table, const RunFileContext& context, LampSpec& lamp) {
    const std::optional<Vec3> position = table.required("position", table.vector("position"));
    const auto aim = read_direction(table, "aim", Vec3{0, 0, -1}, context);
    const Vec3 north = normalized(context.orientation.inward(context.orientation.north()));
    const auto along = read_direction(table, "along", north, context);
    if (!position || !aim || !along) {
        return false;
    }
    if (table.any("along") != nullptr && std::abs(dot(*aim, *along)) > 1 - 1e-12) {
        table.fault_at("along", "along is parallel to aim", "it must point across it");
        return false;
    }
    lamp.position = context.orientation.inward(*position);
    lamp.axes = lamp_axes(*aim, *along);
    return true;
}

std::optional<double> required_size(TableReader& table, std::string_view key) {
    return table.required(key, table.real(key, kPositive));
}

bool read_point(TableReader& table, const RunFileContext& context, LampSpec& lamp) {
    return read_pose(table, context, lamp);
}

bool read_spot(TableReader& table, const RunFileContext& context, LampSpec& lamp) {
    const auto exponent = table.real("exponent", {0, 1e6});
    const auto cone = table.real("cone_deg", {1e-3, 180});
    const auto soft = table.real("soft_from_deg", {0, 180});
    if ((table.any("exponent") != nullptr) == (table.any("cone_deg") != nullptr)) {
        table.fault(
            "its beam needs either cone_deg or exponent", "",
            "give cone_deg (angle from the axis at which the light ends; soft_from_deg: where it "
            "begins to decrease) or exponent (intensity is proportional to cos^exponent)");
        return false;
    }
    if (soft && (!cone || *soft > *cone)) {
        table.fault_at(
            "soft_from_deg", fmt::format("soft_from_deg is {}", shortest(*soft)),
            "it needs cone_deg and must not exceed it");
        return false;
    }
    const bool is_placed = read_pose(table, context, lamp);
    if (exponent) {
        lamp.pattern = power_cosine_pattern(*exponent);
    } else if (cone) {
        lamp.pattern = spot_pattern(soft.value_or(*cone) * kRadians, *cone * kRadians);
    }
    return is_placed && !table.failed();
}

bool read_rectangle(TableReader& table, const RunFileContext& context, LampSpec& lamp) {
    const auto length = required_size(table, "length");
    const auto width = required_size(table, "width");
    lamp.pattern = cosine_pattern();
    lamp.opening = {Opening::Kind::rectangle, length.value_or(0), width.value_or(0), 0};
    return read_pose(table, context, lamp) && length && width;
}

bool read_disk(TableReader& table, const RunFileContext& context, LampSpec& lamp) {
    const auto radius = required_size(table, "radius");
    lamp.pattern = cosine_pattern();
    lamp.opening = {Opening::Kind::disk, 0, 0, radius.value_or(0)};
    return read_pose(table, context, lamp) && radius;
}

bool read_ball(TableReader& table, const RunFileContext& context, LampSpec& lamp) {
    const auto radius = required_size(table, "radius");
    const auto position = table.required("position", table.vector("position"));
    lamp.pattern = cosine_pattern();
    lamp.opening = {Opening::Kind::sphere, 0, 0, radius.value_or(0)};
    lamp.position = context.orientation.inward(position.value_or(Vec3{}));
    return radius && position;
}

bool read_line(TableReader& table, const RunFileContext& context, LampSpec& lamp) {
    const auto from = table.required("from", table.vector("from"));
    const auto to = table.required("to", table.vector("to"));
    if (!from || !to) {
        return false;
    }
    const Vec3 along = context.orientation.inward(*to - *from);
    if (length(along) == 0) {
        table.fault("from and to are the same point", "a line needs a length");
        return false;
    }
    lamp.position = context.orientation.inward(0.5 * (*from + *to));
    lamp.axes = frame_about(normalized(along));
    lamp.opening = {Opening::Kind::line, length(along), 0, 0};
    lamp.pattern = tube_pattern();
    return true;
}

/// Reads a photometric file: a lamp with the file's opening, in the scene's unit, or a point.
bool read_ies_lamp(TableReader& table, const RunFileContext& context, LampSpec& lamp) {
    constexpr std::array<std::string_view, 2> kOpenings{"file", "point"};
    const std::optional<std::string> path = table.required("file", table.text("file"));
    const bool is_point = table.choice("opening", kOpenings) == "point";
    const bool is_placed = read_pose(table, context, lamp);
    const std::optional<double> square = square_metres(table, context);
    if (!path || !square) {
        return false;
    }
    Reporter own{*path, {}, {}};
    std::optional<IesFile> file;
    try {
        file = read_ies(context.files->read(*path), own);
    } catch (const InputError& error) {
        own.faults.add(error);
    }
    const bool is_read = own.faults.empty();
    table.reporter().add(own);
    if (!is_read) {
        return false;
    }
    const double unit = 1 / std::sqrt(*square);
    if (!is_point && file->radius_m > 0) {
        lamp.opening = {Opening::Kind::disk, 0, 0, unit * file->radius_m};
    } else if (!is_point && file->length_m * file->width_m > 0) {
        lamp.opening = {Opening::Kind::rectangle, unit * file->length_m, unit * file->width_m, 0};
    }
    lamp.pattern = web_pattern(std::move(file->web));
    return is_placed;
}

/// Reader of one kind of lamp, which the catalogue describes.
struct LampKind {
    std::string_view name;
    bool (*read)(TableReader& table, const RunFileContext& context, LampSpec& lamp);
};
constexpr std::array kLampKinds{
    LampKind{"point", read_point},         LampKind{"spot", read_spot},
    LampKind{"rectangle", read_rectangle}, LampKind{"disk", read_disk},
    LampKind{"line", read_line},           LampKind{"sphere", read_ball},
    LampKind{"ies", read_ies_lamp}};

std::string format_point(const Vec3& p) {
    return fmt::format("({}, {}, {})", shortest(p.x), shortest(p.y), shortest(p.z));
}

/// Adds the flux of a key to the bands in its unit; it must be 0 for other bands. @returns false
/// after a fault
bool add_flux(
    TableReader& table,
    const FluxKey& key,
    const RunFileContext& context,
    std::vector<double>& flux) {
    const auto given = read_per_band(table, key.key, context.bands, TableReader::kLight);
    for (std::size_t b = 0; given && b < flux.size(); ++b) {
        const Band& band = context.bands[b];
        if (band.unit != key.of_band && (*given)[b] != 0) {
            table.fault_at(
                key.key, fmt::format("{} for band '{}' in {}", key.key, band.name, band.unit),
                fmt::format("the unit of the band is {}, irradiance {}", key.unit, key.of_band),
                "give the flux of each band in its unit, and 0 for bands with another unit");
            return false;
        }
        flux[b] += (*given)[b];
    }
    return given.has_value();
}

/// The flux of a lamp, per band, in irradiance unit x square scene unit; empty after a fault.
std::optional<std::vector<double>> read_flux(TableReader& table, const RunFileContext& context) {
    std::vector<double> flux(context.bands.size());
    bool is_given = false;
    bool is_good = true;
    for (const FluxKey& key : kFluxKeys) {
        if (table.any(key.key) != nullptr) {
            is_given = true;
            is_good = add_flux(table, key, context, flux) && is_good;
        }
    }
    if (!is_given) {
        table.fault(
            "its flux is missing", "",
            "give power [W], photon_flux [umol s-1] or luminous_flux [lm], per band");
        return std::nullopt;
    }
    const std::optional<double> square = is_good ? square_metres(table, context) : std::nullopt;
    if (!square) {
        return std::nullopt;
    }
    for (double& value : flux) {
        value /= *square;
    }
    return flux;
}

/// "emits PAR 400 umol s-1"
std::string format_flux(const std::vector<double>& flux, const RunFileContext& context) {
    std::string text = "emits";
    for (std::size_t b = 0; b < flux.size(); ++b) {
        const FluxUnit unit = named_flux_unit(context.bands[b].unit, context.length_unit);
        text += fmt::format(
            "{} {} {:.6g} {}", b == 0 ? "" : ",", context.bands[b].name, unit.factor * flux[b],
            unit.name);
    }
    return text;
}

}  // namespace

std::optional<Vec3> read_direction(
    TableReader& table,
    std::string_view key,
    const std::optional<Vec3>& usual,
    const RunFileContext& context) {
    std::optional<Vec3> given = table.vector(key);
    if (usual && table.any(key) == nullptr) {
        return usual;
    }
    given = table.required(key, given);
    if (!given) {
        return std::nullopt;
    }
    const double size = std::max({std::abs(given->x), std::abs(given->y), std::abs(given->z)});
    if (size == 0) {
        table.fault_at(key, fmt::format("{} is [0, 0, 0]", key), "it has no direction");
        return std::nullopt;
    }
    return normalized(context.orientation.inward(*given / size));
}

std::optional<NotedSource> read_lamp(
    TableReader& table, const std::string& name, const RunFileContext& context) {
    const std::string type = table.text("type").value_or("");
    LampSpec lamp;
    lamp.name = name;
    const LampKind* kind = nullptr;
    for (const LampKind& row : kLampKinds) {
        kind = row.name == type ? &row : kind;
    }
    const bool is_read = kind->read(table, context, lamp);
    const auto flux = read_flux(table, context);
    if (!is_read || !flux) {
        return std::nullopt;
    }
    lamp.flux = *flux;
    const Orientation& axes = context.orientation;
    const std::string note = fmt::format(
        "{}: {} at {}, aimed along {}; {}", name, find_source(type)->words,
        format_point(axes.outward(lamp.position)), format_vector(axes.outward(lamp.axes.n)),
        format_flux(*flux, context));
    return NotedSource{make_lamp(std::move(lamp)), note};
}

}  // namespace quasimc

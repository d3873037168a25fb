#include "runfile/run_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/length_units.h"
#include "base/text.h"
#include "runfile/written.h"
#include "scene/build_scene.h"

namespace quasimc {
namespace {

constexpr std::int64_t kRunFileVersion = 1;

Orientation read_orientation(TableReader& top) {
    constexpr std::array<std::string_view, 2> kAxes{"z", "y"};
    const UpAxis up = top.choice("up", kAxes) == "y" ? UpAxis::y : UpAxis::z;
    const Vec3 usual = Orientation(up, {}).outward({0, 1, 0});
    const Vec3 north = top.vector("north").value_or(usual);
    const Vec3 inward = Orientation(up, north).inward(north);
    const bool is_horizontal = inward.z == 0 && std::isfinite(length(inward)) && length(inward) > 0;
    if (!is_horizontal) {
        top.fault_at(
            "north", "north is not a horizontal direction",
            "it must have a length and be perpendicular to the up axis");
    }
    return {up, is_horizontal ? north : usual};
}

void read_format_version(TableReader& top) {
    const auto version = top.integer("format", {1, 1e9});
    if (version && *version > kRunFileVersion) {
        top.fault_at(
            "format", fmt::format("format is {}", *version),
            fmt::format("this program reads formats up to {}", kRunFileVersion),
            "use a newer program");
    }
}

/// The unit of length of a document, "m" if none is given. Refuses another case of a known unit.
std::string read_length_unit(TableReader& top) {
    std::string unit = top.text("length_unit").value_or("m");
    const std::string lower = lower_case(unit);
    if (!metres_per(unit) && metres_per(lower)) {
        top.fault_at(
            "length_unit", fmt::format("there is no unit '{}'", one_line(unit)), "",
            fmt::format("did you mean '{}'?", lower));
    }
    return unit;
}

/// Begins the scene, with a warning of a unit of unknown length.
SceneBuilder begin_scene(const RunFileContext& context) {
    const std::string& unit = context.length_unit;
    if (!unit.empty() && !metres_per(unit)) {
        context.reporter->warn(fmt::format(
            "the length_unit '{0}' is only a name: areas are in {0}2, and sizes are not "
            "checked; known units are {1}",
            unit, kLengthUnitText));
    }
    SceneBuilder builder(context.bands, context.orientation);
    builder.set_length_unit(context.length_unit);
    return builder;
}

/// Adds a substitute for unreadable organs, to avoid a further fault that there are none.
void add_substitute(SceneBuilder& builder, const RunFileContext& context) {
    std::string material = "stand-in";
    if (context.materials.empty()) {
        const std::vector<SideOptics> black(context.bands.size());
        builder.add_material({material, black, black});
    } else {
        material = *context.materials.begin();
    }
    OrganSpec organ;
    organ.parts.push_back({std::move(material), std::vector<Triangle>(1, kSubstitute)});
    builder.add_organ(std::move(organ));
}

/// A scene of the bands alone, for checks that need no organs; empty if the bands have faults.
std::optional<Scene> scene_of_bands(RunFileContext context) {
    context.materials.clear();
    SceneBuilder builder = begin_scene(context);
    add_substitute(builder, context);
    try {
        return std::move(builder).build();
    } catch (const InputError&) {  // reported with the scene of all organs
        return std::nullopt;
    }
}

/// Whether a reader adds no faults.
template <typename Read>
bool reads_well(const Faults& faults, Read read) {
    const std::size_t before = faults.size();
    read();
    return faults.size() == before;
}

/// Marks keys as read that another reader reads.
void pass_over(TableReader& top, std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) {
        static_cast<void>(top.any(key));
    }
}

/// The contents of sections that refer to the ground, beside sensors, which the scene has.
struct OnGround {
    std::vector<GapFractionSpec> gap_fractions;
    KnownParts known = {};  ///< its scene and sensors
};

/// Reads what refers to the ground. @param ground  may be absent
OnGround read_on_ground(
    TableReader& top,
    const std::optional<GroundSpec>& ground,
    RunFileContext& context,
    SceneBuilder& builder) {
    OnGround read;
    context.ground = ground ? &*ground : nullptr;
    read.known.sensors =
        reads_well(top.reporter().faults, [&] { read_sensors(top, context, builder); });
    read.gap_fractions = read_gap_fractions(top, context);
    context.ground = nullptr;
    return read;
}

/// @param add_organs  adds organs after those of the file; may be empty
OnGround read_geometry_sections(
    TableReader& top, RunFileContext& context, const AddOrgans& add_organs, SceneBuilder& builder) {
    if (context.meshes != nullptr) {
        context.meshes->start_point();
    }
    std::optional<GroundSpec> ground;
    const bool has_scene = reads_well(top.reporter().faults, [&] {
        ground = read_ground(top, context);
        context.ground = ground ? &*ground : nullptr;
        read_organs(top, context, builder);
        read_geometry(top, context, builder);
        if (add_organs) {
            add_organs(builder);
        }
        read_cell(top, context, builder);
    });
    OnGround read = read_on_ground(top, ground, context, builder);
    read.known.scene = has_scene;
    if (ground) {
        builder.set_ground(*std::move(ground));
    }
    return read;
}

/// Reads what refers to the ground of a known scene.
OnGround read_on_known_ground(TableReader& top, RunFileContext& context, SceneBuilder& builder) {
    return read_on_ground(top, read_ground(top, context), context, builder);
}

/// Reads sources, [time], and the lamps that are controlled at its times.
/// @param scene  see read_controls()
void read_light(TableReader& top, RunFileContext& context, const Scene* scene, Sections& sections) {
    sections.sources = read_sources(top, context);
    std::optional<TimeSeries>& series = sections.series;
    series = read_time(top, context, sections.sources);
    std::vector<LampControl> controls =
        read_controls(top, context, sections.sources, series ? &*series : nullptr, scene);
    if (series) {
        series->controls = std::move(controls);
    }
    sections.known.sources =
        sections.known.bands && sections.sources.is_whole && series.has_value() == context.has_time;
}

/// Reads the keys that all sections need.
RunFileContext read_context(TableReader& top, InputFiles& files) {
    read_format_version(top);
    return {
        .reporter = &top.reporter(),
        .files = &files,
        .bands = read_bands(top),
        .orientation = read_orientation(top),
        .materials = {},
        .site = read_site(top),
        .sun = {},
        .length_unit = read_length_unit(top),
        .has_time = top.any("time") != nullptr,
        .meshes = nullptr,
        .ground = nullptr};
}

UnitOrigin unit_origin(TableReader& top) {
    return top.any("length_unit") != nullptr ? UnitOrigin::given : UnitOrigin::assumed;
}

/// Refuses [sweep], which has several scenes or lights.
void refuse_sweep(TableReader& top) {
    if (const Node* sweep = top.any("sweep")) {
        top.fault_at(
            *sweep, "[sweep] describes several runs", "a scene is one run",
            "run the file with the program, `quasimc run`, or take [sweep] out");
    }
}

}  // namespace

std::optional<Scene> build(SceneBuilder builder, const KnownScene& known, Reporter& reporter) {
    try {
        return known.same != nullptr       ? build_on(builder, *known.same)
               : known.overlaps != nullptr ? build_after(std::move(builder), known.overlaps)
                                           : std::move(builder).build();
    } catch (const InputError& error) {
        for (Fault fault : error.faults()) {
            // Faults without a line belong to the run file.
            const bool is_whole =
                fault.where.find(':') != std::string::npos || fault.where == reporter.file;
            fault.where = is_whole ? fault.where : reporter.file + ": " + fault.where;
            reporter.faults.add(std::move(fault));
        }
        return std::nullopt;
    }
}

Sections read_sections(
    TableReader& top, InputFiles& files, const std::vector<Override>& overrides, KnownScene known) {
    Sections sections;
    sections.title = top.text("title").value_or("");
    RunFileContext context = read_context(top, files);
    sections.unit_origin = unit_origin(top);
    context.meshes = known.meshes;
    SceneBuilder builder = begin_scene(context);
    const Faults& faults = top.reporter().faults;
    sections.known.bands = faults.empty();
    read_run_options(top, sections.options);
    apply_overrides(overrides, sections.options, top.reporter());
    sections.known.unknown_options = sections.options.unknown;
    const bool has_materials = reads_well(faults, [&] { read_materials(top, context, builder); });
    read_light(top, context, nullptr, sections);
    known.same = known.same != nullptr && can_build_on(builder, *known.same) ? known.same : nullptr;
    if (known.same != nullptr) {
        pass_over(top, {"organ", "geometry", "cell"});
    }
    OnGround on_ground = known.same != nullptr ? read_on_known_ground(top, context, builder)
                                               : read_geometry_sections(top, context, {}, builder);
    sections.gap_fractions = std::move(on_ground.gap_fractions);
    read_detectors(top, builder);
    sections.known.scene = sections.known.bands && has_materials && on_ground.known.scene;
    sections.known.sensors = sections.known.scene && on_ground.known.sensors;
    sections.output =
        read_output(top, files, context.bands);  // after all sections that it refers to
    read_tables(top, files, context.bands, sections.output);
    if (needs_parts(sections.output)) {
        sections.options.spec.sun_shade = SunShade::apart;
    }
    refuse_options_at_the_top(top);
    top.finish();
    if (!sections.known.scene) {
        add_substitute(builder, context);
    }
    sections.is_on_base = known.same != nullptr;
    sections.scene = build(std::move(builder), known, top.reporter());
    if (!sections.scene) {
        sections.known.scene = sections.known.sensors = false;
        sections.scene = scene_of_bands(context);
    }
    return sections;
}

Sections read_light_sections(TableReader& top, InputFiles& files, const Scene& scene) {
    pass_over(
        top, {"title", "material", "material_file", "organ", "geometry", "ground", "cell",
              "sensors", "detector", "gap_fraction", "output", "table"});
    refuse_sweep(top);
    RunFileContext context = read_context(top, files);
    Sections sections;
    sections.unit_origin = unit_origin(top);
    sections.known.bands = top.reporter().faults.empty();
    read_run_options(top, sections.options);
    sections.known.unknown_options = sections.options.unknown;
    read_light(top, context, &scene, sections);
    top.finish();
    return sections;
}

FrameOfRun read_frame(
    const Node& document, InputFiles& files, const AddOrgans& add_organs, Reporter& reporter) {
    TableReader top(document, "", reporter);
    pass_over(top, {"title", "run", "source", "light_file", "control", "output", "table"});
    refuse_sweep(top);
    RunFileContext context = read_context(top, files);
    SceneBuilder builder = begin_scene(context);
    read_materials(top, context, builder);
    std::vector<GapFractionSpec> gap_fractions =
        read_geometry_sections(top, context, add_organs, builder).gap_fractions;
    read_detectors(top, builder);
    refuse_options_at_the_top(top);
    top.finish();
    if (!reporter.faults.empty()) {
        add_substitute(builder, context);
    }
    return {std::move(builder), std::move(gap_fractions), {}};
}

}  // namespace quasimc

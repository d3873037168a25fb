#include "runfile/run_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <initializer_list>
#include <limits>

#include <fmt/format.h>

#include "base/length_units.h"
#include "base/text.h"
#include "light/source_origins.h"
#include "planner/lint_bundles.h"
#include "planner/lint_lamps.h"
#include "planner/lint_wedges.h"
#include "quasimc/source.h"
#include "runfile/run_file_sections.h"
#include "runfile/written.h"
#include "scene/build_scene.h"
#include "scene/fold_warnings.h"
#include "scene/lint.h"
#include "series/trace_spec.h"
#include "text/numbers.h"

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

/// The content of all sections of a run file.
struct Sections {
    std::string title;
    std::optional<Scene> scene;
    SourceList sources;
    std::optional<TimeSeries> series;
    RunOptions options;
    OutputSpec output;
    std::vector<GapFractionSpec> gap_fractions;
    bool is_on_base = false;  ///< whether it shares the geometry of the base
    KnownParts known = {};
    UnitOrigin unit_origin = UnitOrigin::assumed;
};

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

/// Reads [time], and the lamps that are controlled at its times.
/// @param scene  see read_controls()
std::optional<TimeSeries> read_series(
    TableReader& top,
    const RunFileContext& context,
    const SourceList& sources,
    const Scene* scene) {
    std::optional<TimeSeries> series = read_time(top, context, sources);
    std::vector<LampControl> controls =
        read_controls(top, context, sources, series ? &*series : nullptr, scene);
    if (series) {
        series->controls = std::move(controls);
    }
    return series;
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

Sections read_sections(
    TableReader& top, InputFiles& files, const std::vector<Override>& overrides, KnownScene known) {
    Sections sections;
    sections.title = top.text("title").value_or("");
    RunFileContext context = read_context(top, files);
    sections.unit_origin = unit_origin(top);
    context.meshes = known.meshes;
    SceneBuilder builder = begin_scene(context);
    const Faults& faults = top.reporter().faults;
    const bool has_context = faults.empty();
    sections.known.bands = has_context;
    read_run_options(top, sections.options);
    apply_overrides(overrides, sections.options, top.reporter());
    sections.known.unknown_options = sections.options.unknown;
    const bool has_materials = reads_well(faults, [&] { read_materials(top, context, builder); });
    sections.sources = read_sources(top, context);
    sections.series = read_series(top, context, sections.sources, nullptr);
    sections.known.sources =
        has_context && sections.sources.is_whole && sections.series.has_value() == context.has_time;
    known.same = known.same != nullptr && can_build_on(builder, *known.same) ? known.same : nullptr;
    if (known.same != nullptr) {
        pass_over(top, {"organ", "geometry", "cell"});
    }
    OnGround on_ground = known.same != nullptr ? read_on_known_ground(top, context, builder)
                                               : read_geometry_sections(top, context, {}, builder);
    sections.gap_fractions = std::move(on_ground.gap_fractions);
    read_detectors(top, builder);
    sections.known.scene = has_context && has_materials && on_ground.known.scene;
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

/// Checks that times have lengths, which a day's sum needs.
void check_path_allocation(const Sections& sections, const Reporter& reporter, Faults& faults) {
    if (sections.options.spec.path_allocation == PathAllocation::equal) {
        return;
    }
    if (!sections.series) {
        faults.add(
            {"path_allocation", "it is \"proportional\"",
             "the run has no " + reporter.table_name("time"), "remove it"});
        return;
    }
    const auto& steps = sections.series->time_steps;
    if (std::any_of(steps.begin(), steps.end(), [](const auto& s) { return s.seconds == 0; })) {
        faults.add(
            {"path_allocation", "it is \"proportional\"", "instants do not count in daily sums",
             "give duration_minutes, or leave path_allocation out"});
    }
}

void check_hours(const Sections& sections, const Reporter& reporter, Faults& faults) {
    const RunSpec& spec = sections.options.spec;
    if (sections.series) {
        check_together(*sections.scene, sections.series->time_steps, spec, faults);
    } else if (spec.time_method == TimeMethod::daylight_coefficients) {
        faults.add(
            {"time_method", "it is \"daylight_coefficients\"",
             "the run has no " + reporter.table_name("time"), "remove it"});
    }
}

/// Refuses sunlit and shaded parts of a cumulative sky.
void check_parts(const Sections& sections, Faults& faults) {
    if (sections.options.spec.sun_shade == SunShade::apart && sections.series &&
        sections.series->cumulative_sky != CumulativeSky::none) {
        faults.add(
            {"sun_shade", "light of sunlit and shaded parts, with a cumulative sky",
             "no instants are left, in which a part is sunlit", "leave cumulative_sky out"});
    }
}

/// The sources of the file, or of all its times.
Sources all_sources(const Sections& sections) {
    return sections.series ? sources_of(sections.series->time_steps) : sections.sources.sources;
}

/// The sources that a run is checked with: its own, those of a time step with light, or a
/// substitute if no light is allowed and there is none.
Sources checked_sources(
    const Sections& sections, const Scene& scene, NoLightPolicy no_light_policy) {
    const std::vector<double> one(scene.bands().size(), 1.0);
    if (!sections.series) {
        const Sources& sources = sections.sources.sources;
        return no_light_policy == NoLightPolicy::allowed && is_dark(sources)
                   ? Sources{make_uniform_sky("night", one)}
                   : sources;
    }
    const std::vector<TimeStepPlan> plans = plan_series(sections.series->time_steps);
    const auto lit =
        std::find_if(plans.begin(), plans.end(), [](const auto& plan) { return plan.factor > 0; });
    return lit == plans.end()
               ? Sources{make_uniform_sky("night", one)}
               : sections.series->time_steps[static_cast<std::size_t>(lit - plans.begin())].sources;
}

/// Checks the known parts of a run.
void check_with_sources(
    const Sections& sections, const Scene& scene, Faults& faults, NoLightPolicy no_light_policy) {
    const RunSpec& spec = sections.options.spec;
    Sources sources;
    if (sections.known.sources) {
        check_origins(all_sources(sections), spec.origins, faults);
        sources = checked_sources(sections, scene, no_light_policy);
    }
    check_known_parts(scene, sources, spec, sections.known, faults);
}

/// Checks that options fit the times, if all of these are known.
void check_times(const Sections& sections, const Reporter& reporter, Faults& faults) {
    const KnownParts& known = sections.known;
    if (known.sources) {
        check_path_allocation(sections, reporter, faults);
        check_parts(sections, faults);
    }
    if (known.sources && known.scene) {
        check_hours(sections, reporter, faults);
    }
}

/// Refuses [sweep], which has several scenes or lights.
void refuse_sweep(TableReader& top) {
    if (const Node* sweep = top.any("sweep")) {
        top.fault_at(
            *sweep, "[sweep] describes several runs", "a scene is one run",
            "run the file with the program, `quasimc run`, or take [sweep] out");
    }
}

/// Reads the part of a document that defines the scene.
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

/// The line of a location "file:line"; other locations sort after all lines.
std::uint64_t line_of(const std::string& where, const std::string& file) {
    constexpr std::uint64_t kNowhere = std::numeric_limits<std::uint64_t>::max();
    if (!where.starts_with(file + ":")) {
        return kNowhere;
    }
    const std::string_view rest = std::string_view(where).substr(file.size() + 1);
    const auto line = parse_integer(rest.substr(0, rest.find(':')));
    return line ? static_cast<std::uint64_t>(*line) : kNowhere;
}

/// Throws the faults in the order of the file's lines.
void throw_in_order(const Reporter& reporter) {
    if (reporter.faults.empty()) {
        return;
    }
    std::vector<Fault> faults = reporter.faults.all();
    sort_by_line(faults, reporter.file);
    throw InputError(std::move(faults));
}

/// Warnings of lint(). Those of the geometry alone were reported with the base.
std::vector<Warning> lint_of(const Sections& sections) {
    const Scene& scene = *sections.scene;
    std::vector<Warning> found =
        sections.is_on_base ? std::vector<Warning>() : lint_geometry(scene);
    const Sources& sources = sections.sources.sources;
    for (auto& more :
         {lint_lamp_unit(scene, sources, sections.unit_origin), lint_lamp_positions(scene, sources),
          lint_wedges(scene, sources), lint_bundles(scene, sources, sections.options.spec)}) {
        found.insert(found.end(), more.begin(), more.end());
    }
    return found;
}

/// Parses a run file. Reports files of another kind, such as geometry.
Node read_file_of_run(const std::string& text, const std::string& name) {
    const std::string extension = std::filesystem::path(name).extension().string();
    try {
        return read_toml(text, name);
    } catch (const InputError& error) {
        if (const ForeignFormat* foreign = foreign_format_of_path(name)) {
            throw InputError(
                {{name, fmt::format("is {}, not a run file", foreign->name), "it is not supported",
                  std::string(foreign->advice)}});
        }
        if (extension == ".json") {
            throw InputError(
                {{name, "is a result, not a run file", "",
                  fmt::format(
                      "show it: quasimc view {0}; or repeat its run: quasimc run --repeat {0}",
                      name)}});
        }
        const FormatEntry* geometry = extension == ".txt" ? nullptr : format_of_path(name);
        if (geometry != nullptr) {
            throw InputError(
                {{name, "is geometry, not a run file", "",
                  fmt::format(
                      "name it in a run file, under [[geometry]]: file = \"{}\"; or draw it: "
                      "quasimc show {}",
                      std::filesystem::path(name).filename().string(), name)}});
        }
        if (extension.empty() || extension == ".toml") {
            throw;
        }
        throw InputError(
            {{name, "is not a run file", error.faults().front().text(),
              "give a run file in TOML; `quasimc --dump-default` prints one"}});
    }
}

/// A run file that was read, but not parsed.
struct OpenedRun {
    std::string name, text;
    InputFiles files;
};

OpenedRun open_run(const std::string& path, const FileAccess& access) {
    const std::filesystem::path absolute = access.absolute(path);
    OpenedRun run{
        path == "-" ? "standard input" : path, access.read(path),
        InputFiles(absolute.parent_path(), access)};
    run.files.note(path, absolute, run.text);
    run.files.mark_run_file();
    return run;
}

}  // namespace

bool is_dark(const Sources& sources) {
    return std::all_of(sources.begin(), sources.end(), [](const auto& source) {
        const auto spectrum = source->spectrum();
        return std::all_of(spectrum.begin(), spectrum.end(), [](double x) { return x == 0; });
    });
}

std::vector<TimeStep> time_steps_of(RunFile& run, Simulator& simulator) {
    if (run.series) {
        TimeSeries& series = *run.series;
        if (series.outcomes.size() < series.controls.size()) {
            series.outcomes = control_lamps(
                {run.scene, run.sources, run.spec, series.controls}, simulator, series.time_steps);
        }
        return series.time_steps;
    }
    TimeStep only;
    only.sources = run.sources;
    return {std::move(only)};
}

void sort_by_line(std::vector<Fault>& faults, const std::string& file) {
    std::stable_sort(faults.begin(), faults.end(), [&](const Fault& a, const Fault& b) {
        return line_of(a.where, file) < line_of(b.where, file);
    });
}

RunFile read_run_document(
    Node document,
    const std::string& name,
    InputFiles& files,
    const std::vector<Override>& overrides,
    const KnownScene& known,
    NoLightPolicy no_light_policy) {
    Reporter reporter{name, {}, {}};
    TableReader top(document, "", reporter);
    Sections sections = read_sections(top, files, overrides, known);
    if (!sections.scene) {
        throw_in_order(reporter);
    }
    Faults faults;
    check_with_sources(sections, *sections.scene, faults, no_light_policy);
    check_times(sections, reporter, faults);
    add_run_faults(faults, sections.options, reporter);
    std::vector<Warning> warnings;
    if (reporter.faults.empty()) {
        warnings = fold_warnings(std::move(reporter.warnings), lint_of(sections));
    }
    RunFile run{
        name,
        std::move(sections.title),
        std::move(*sections.scene),
        std::move(sections.sources.sources),
        sections.options.spec,
        std::move(sections.series),
        std::move(sections.gap_fractions),
        std::move(sections.output),
        files.files(),
        files.folder().string(),
        std::move(sections.sources.notes),
        std::move(warnings),
        std::make_shared<const Node>(completed(std::move(document), sections.options.spec))};
    check_rows(run, sections.known, reporter);
    check_gaps(
        sections.known.scene ? &run.scene : nullptr, run.gap_fractions, reporter.faults,
        run.warnings);
    throw_in_order(reporter);
    return run;
}

SceneOfRun read_scene_document(
    const Node& document,
    const std::string& name,
    InputFiles& files,
    const AddOrgans& add_organs,
    KnownOverlaps* overlaps,
    const Vocabulary& vocabulary) {
    Reporter reporter{name, {}, {}, vocabulary};
    FrameOfRun frame = read_frame(document, files, add_organs, reporter);
    std::optional<Scene> scene = build(std::move(frame.builder), {.overlaps = overlaps}, reporter);
    if (reporter.faults.empty()) {
        check_gaps(&*scene, frame.gap_fractions, reporter.faults, reporter.warnings);
    }
    throw_in_order(reporter);
    std::vector<Warning> warnings =
        fold_warnings(std::move(reporter.warnings), lint_geometry(*scene));
    return {std::move(*scene), std::move(frame.gap_fractions), std::move(warnings), files.files()};
}

FrameOfRun read_frame_document(
    const Node& document,
    const std::string& name,
    InputFiles& files,
    const AddOrgans& add_organs,
    const Vocabulary& vocabulary) {
    Reporter reporter{name, {}, {}, vocabulary};
    FrameOfRun frame = read_frame(document, files, add_organs, reporter);
    throw_in_order(reporter);
    frame.warnings = fold_warnings(std::move(reporter.warnings));
    return frame;
}

LightOfRun read_light_document(
    const Node& document,
    const std::string& name,
    InputFiles& files,
    const Scene& scene,
    const Vocabulary& vocabulary) {
    Reporter reporter{name, {}, {}, vocabulary};
    TableReader top(document, "", reporter);
    pass_over(
        top, {"title", "material", "material_file", "organ", "geometry", "ground", "cell",
              "sensors", "detector", "gap_fraction", "output", "table"});
    refuse_sweep(top);
    RunFileContext context = read_context(top, files);
    Sections sections;
    const bool has_context = reporter.faults.empty();
    sections.known.bands = has_context;
    read_run_options(top, sections.options);
    sections.known.unknown_options = sections.options.unknown;
    sections.sources = read_sources(top, context);
    sections.series = read_series(top, context, sections.sources, &scene);
    sections.known.sources =
        has_context && sections.sources.is_whole && sections.series.has_value() == context.has_time;
    top.finish();
    Faults faults;
    check_with_sources(sections, scene, faults, NoLightPolicy::refused);
    add_run_faults(faults, sections.options, reporter);
    throw_in_order(reporter);
    for (auto& more :
         {lint_lamp_unit(scene, sections.sources.sources, unit_origin(top)),
          lint_lamp_positions(scene, sections.sources.sources)}) {
        reporter.warnings.insert(reporter.warnings.end(), more.begin(), more.end());
    }
    return {
        std::move(sections.sources.sources), std::move(sections.options.spec),
        std::move(sections.series), std::move(sections.sources.notes),
        fold_warnings(std::move(reporter.warnings))};
}

RunFile read_run_text(
    std::string_view text,
    const std::string& name,
    InputFiles& files,
    const std::vector<Override>& overrides) {
    return read_run_document(read_toml(text, name), name, files, overrides);
}

RunSweep read_run_sweep(const std::string& path, const std::vector<Override>& overrides) {
    return read_run_sweep(path, overrides, FileAccess());
}

RunSweep read_run_sweep(
    const std::string& path,
    const std::vector<Override>& overrides,
    const FileAccess& access,
    const OnPointRead& on_point) {
    const OpenedRun run = open_run(path, access);
    return read_sweep_document(
        read_file_of_run(run.text, run.name), run.name, [run] { return run.files; }, overrides,
        on_point);
}

SceneOfRun read_scene_of_run(const std::string& path) {
    OpenedRun run = open_run(path, FileAccess());
    return read_scene_document(read_file_of_run(run.text, run.name), run.name, run.files);
}

RunFile read_run_file(const std::string& path, const std::vector<Override>& overrides) {
    return read_run_sweep(path, overrides).only_run();
}

}  // namespace quasimc

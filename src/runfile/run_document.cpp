#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "planner/lint_bundles.h"
#include "planner/lint_lamps.h"
#include "planner/lint_wedges.h"
#include "runfile/check_sections.h"
#include "runfile/run_file.h"
#include "runfile/run_sections.h"
#include "scene/fold_warnings.h"
#include "scene/lint.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

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

}  // namespace

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
    Sections sections = read_light_sections(top, files, scene);
    Faults faults;
    check_with_sources(sections, scene, faults, NoLightPolicy::refused);
    add_run_faults(faults, sections.options, reporter);
    throw_in_order(reporter);
    for (auto& more :
         {lint_lamp_unit(scene, sections.sources.sources, sections.unit_origin),
          lint_lamp_positions(scene, sections.sources.sources)}) {
        reporter.warnings.insert(reporter.warnings.end(), more.begin(), more.end());
    }
    return {
        std::move(sections.sources.sources), std::move(sections.options.spec),
        std::move(sections.series), std::move(sections.sources.notes),
        fold_warnings(std::move(reporter.warnings))};
}

}  // namespace quasimc

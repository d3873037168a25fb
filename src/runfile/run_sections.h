#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/lint_lamps.h"
#include "quasimc/gap_fraction.h"
#include "quasimc/run_file.h"
#include "run/known_parts.h"
#include "runfile/run_file.h"
#include "runfile/run_file_sections.h"
#include "text/table_reader.h"

namespace quasimc {

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

/// Reads all sections, and builds the scene.
/// @param known  parts of the scene that are not read again
[[nodiscard]] Sections read_sections(
    TableReader& top, InputFiles& files, const std::vector<Override>& overrides, KnownScene known);

/// Reads the sections of light and the options; others are ignored. @param scene  of the document
[[nodiscard]] Sections read_light_sections(TableReader& top, InputFiles& files, const Scene& scene);

/// Reads the sections that define the scene; others are ignored.
[[nodiscard]] FrameOfRun read_frame(
    const Node& document, InputFiles& files, const AddOrgans& add_organs, Reporter& reporter);

/// Builds a scene; empty after faults, which are reported.
[[nodiscard]] std::optional<Scene> build(
    SceneBuilder builder, const KnownScene& known, Reporter& reporter);

}  // namespace quasimc

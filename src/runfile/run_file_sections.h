#pragma once

// The sections of a run file, each read by a function of its own. Included by the run_file*.cpp
// only.

#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/input_files.h"
#include "meshio/formats.h"
#include "meshio/mesh_cache.h"
#include "options/options.h"
#include "quasimc/gap_fraction.h"
#include "quasimc/mesh.h"
#include "quasimc/run_file.h"
#include "quasimc/source.h"
#include "run/known_parts.h"
#include "runfile/run_file.h"
#include "scene/scene.h"
#include "text/table_reader.h"
#include "weather/daily_hours.h"

namespace quasimc {

/// Substitute for the triangles of an organ with faults, so that its id and material are checked.
inline constexpr Triangle kSubstitute{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};

/// Position of the sun, as given in a run file.
struct SunSpec {
    Vec3 to_sun;  ///< unit, world with z up
    double distance_au = 1;
    std::string description;  ///< time and site; "" if given by angles
};

/// Data shared by the sections.
struct RunFileContext {
    Reporter* reporter;
    InputFiles* files;
    std::vector<Band> bands;
    Orientation orientation;
    std::set<std::string> materials;  ///< defined in the run file itself
    std::optional<Site> site;         ///< [site]
    std::optional<SunSpec> sun;       ///< sun of the first source of type "sun"
    std::string length_unit = "m";
    bool has_time = false;               ///< whether there is a [time]
    MeshCache* meshes = nullptr;         ///< cache of parsed files; or null
    const GroundSpec* ground = nullptr;  ///< [ground], for heights above it; or null
};

// run_file_sun.cpp
/// Reads [site]; empty if it is absent or has faults.
[[nodiscard]] std::optional<Site> read_site(TableReader& top);

// run_file_options.cpp
/// The options of a run, and the location of each.
struct RunOptions {
    RunSpec spec;
    std::map<std::string_view, std::string> locations;
    std::vector<std::string_view> unknown;  ///< keys of options with faults
};

void read_run_options(TableReader& top, RunOptions& options);
void apply_overrides(
    const std::vector<Override>& overrides, RunOptions& options, Reporter& reporter);
/// Reports options that are at the top by mistake.
void refuse_options_at_the_top(TableReader& top);
/// Adds the faults of check_run(), whose locations are keys, with the locations of the options.
void add_run_faults(const Faults& found, const RunOptions& options, Reporter& reporter);
/// The run file with all options of the run.
[[nodiscard]] Node completed(Node document, const RunSpec& spec);

// run_file_bands.cpp
[[nodiscard]] std::vector<Band> read_bands(TableReader& top);
/// The value of a key for each band: one for all, a list with one per band, or a table by name.
/// Empty if it is absent, or after a fault.
[[nodiscard]] std::vector<const Node*> nodes_per_band(
    TableReader& table, std::string_view key, const std::vector<Band>& bands);
/// nodes_per_band() as numbers.
[[nodiscard]] std::optional<std::vector<double>> read_per_band(
    TableReader& table, std::string_view key, const std::vector<Band>& bands, Range range);
/// read_per_band() for irradiances. Warns of implausibly large ones.
[[nodiscard]] std::optional<std::vector<double>> read_irradiances(
    TableReader& table, std::string_view key, const std::vector<Band>& bands);

// run_file_output.cpp
[[nodiscard]] OutputSpec read_output(
    TableReader& top, const InputFiles& files, const std::vector<Band>& bands);

/// Reads the names of quantities or bands that are written; empty: all. An empty list is a fault.
[[nodiscard]] std::vector<std::string> read_selection(TableReader& table, std::string_view key);

/// Reads the path of an output file, which is no input; empty if it is absent, or after a fault.
[[nodiscard]] std::optional<std::string> read_output_path(
    TableReader& table, std::string_view key, const InputFiles& files);

// run_file_tables.cpp
/// Reads [[table]] after [output].
void read_tables(
    TableReader& top, const InputFiles& files, const std::vector<Band>& bands, OutputSpec& output);
/// Checks the origins and conditions of tables, as far as what they refer to is known.
void check_rows(RunFile& run, const KnownParts& known, Reporter& reporter);

// run_file_detectors.cpp
void read_detectors(TableReader& top, SceneBuilder& builder);

// run_file_materials.cpp
void read_materials(TableReader& top, RunFileContext& context, SceneBuilder& builder);

// run_file_sources.cpp
struct SourceList {
    Sources sources;
    std::vector<std::string> notes;
    std::vector<std::optional<DailyHours>> hours;  ///< empty: it shines all the time
    bool is_whole = true;                          ///< false: some had faults
};
/// Reads all sources; sets context.sun.
[[nodiscard]] SourceList read_sources(TableReader& top, RunFileContext& context);

// run_file_caribu.cpp
/// Reads [[material_file]]: the materials in Caribu's files of optics.
void read_material_files(TableReader& top, RunFileContext& context, SceneBuilder& builder);
/// Reads [[light_file]]: a directional source for each line of Caribu's files of light. Returns
/// false if there is none.
bool read_light_files(TableReader& top, const RunFileContext& context, SourceList& list);
/// Reads `file` of [cell]: low x, low y, high x, high y. Empty if it is absent, or after a fault.
[[nodiscard]] std::optional<std::array<double, 4>> read_pattern_file(
    TableReader& table, const RunFileContext& context);

// run_file_spectrum.cpp
/// Reflectance and transmittance per band, means over a spectrum.
struct SpectralOptics {
    std::vector<double> reflectance, transmittance;
};
/// Reads `spectrum` and `spectrum_light`; empty if they are absent, or after a fault.
[[nodiscard]] std::optional<SpectralOptics> read_spectral_optics(
    TableReader& table, const RunFileContext& context);

// run_file_usual_optics.cpp
/// Reads `optics`, `soil_color` and `water_content`; empty if they are absent, or after a fault.
[[nodiscard]] std::optional<SpectralOptics> read_usual_optics(
    TableReader& table, const RunFileContext& context);

// run_file_prospect.cpp
/// Reads a table `optics` with a leaf model. Empty after a fault. @param node  the table
[[nodiscard]] std::optional<SpectralOptics> read_leaf_model(
    TableReader& material, const Node& node, const RunFileContext& context);

// run_file_time.cpp
/// Reads [time]: the time steps of the run, each with its daylight and the sources that are on.
/// Empty if it is absent, or after a fault.
[[nodiscard]] std::optional<TimeSeries> read_time(
    TableReader& top, const RunFileContext& run, const SourceList& lamps);

// run_file_shapes.cpp
/// The triangles of a table with `shape = ...`; empty when it has faults (reported).
[[nodiscard]] std::vector<Triangle> read_shape(TableReader& organ);
/// The names of the shapes.
[[nodiscard]] std::vector<std::string_view> shape_names();

// run_file_organs.cpp
void read_organs(TableReader& top, RunFileContext& context, SceneBuilder& builder);
/// Empty if it is absent, or after a fault.
[[nodiscard]] std::optional<GroundSpec> read_ground(TableReader& top, RunFileContext& context);
void read_cell(TableReader& top, const RunFileContext& context, SceneBuilder& builder);
[[nodiscard]] Labels read_labels(TableReader& table);
/// Reads `transform`, p -> translate + rotate (scale p); empty if it is absent.
[[nodiscard]] std::optional<Affine> read_transform(TableReader& table);
/// Rotation by `angle` (radians, counter-clockwise) about the unit vector `axis`.
[[nodiscard]] std::array<Vec3, 3> rotation(const Vec3& axis, double angle);
void move_triangles(const Affine& transform, std::vector<Triangle>& triangles);
void move_points(const Affine& transform, std::vector<Vec3>& points);

// run_file_gap_fraction.cpp
/// Checks keys, and positions and conditions against the scene; warns of a condition that no organ
/// fulfils. @param scene  null: unknown
void check_gaps(
    const Scene* scene,
    const std::vector<GapFractionSpec>& specs,
    Faults& faults,
    std::vector<Warning>& warnings);
[[nodiscard]] std::vector<GapFractionSpec> read_gap_fractions(
    TableReader& top, RunFileContext& context);

// run_file_sensors.cpp
/// Reads [[sensors]]; context.ground is set if there is one.
void read_sensors(TableReader& top, RunFileContext& context, SceneBuilder& builder);

// run_file_control.cpp
/// Reads [[control]].
/// @param series  null without [time], or after its faults
/// @param scene  the scene if it was read before; null: its sensors are in the same document
[[nodiscard]] std::vector<LampControl> read_controls(
    TableReader& top,
    const RunFileContext& context,
    const SourceList& sources,
    const TimeSeries* series,
    const Scene* scene);

// run_file_geometry.cpp
void read_geometry(TableReader& top, RunFileContext& context, SceneBuilder& builder);

// run_file_mesh.cpp
/// The geometry in the file that a table names.
struct NamedMesh {
    std::string file;
    const FormatEntry* format = nullptr;
    MeshFile mesh;
};
/// Reads the file that a table names by `file` and `format`; empty after a fault.
[[nodiscard]] std::optional<NamedMesh> read_named_mesh(TableReader& table, RunFileContext& context);
/// Reads files of a table, each once, in the format of its `format` or extension; empty after a
/// fault. @param files  at least one
[[nodiscard]] std::vector<NamedMesh> read_named_meshes(
    TableReader& table, const std::vector<std::string>& files, RunFileContext& context);

}  // namespace quasimc

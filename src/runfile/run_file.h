#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/input_files.h"
#include "quasimc/gap_fraction.h"
#include "quasimc/run_file.h"
#include "text/document.h"
#include "text/table_reader.h"

namespace quasimc {

/// Reads the text of a run file.
/// @param name   for messages
/// @param files  reads the files that the text names, and records them
[[nodiscard]] RunFile read_run_text(
    std::string_view text,
    const std::string& name,
    InputFiles& files,
    const std::vector<Override>& overrides = {});

/// Whether all sources are dark.
[[nodiscard]] bool is_dark(const Sources& sources);

/// Whether a run without light, whose results are zero, is an error.
enum class NoLightPolicy { refused, allowed };

class KnownOverlaps;
class MeshCache;

/// Known parts of a document's scene, which speed up its reading.
struct KnownScene {
    /// A scene with the same organs, ground and cell, which are then not read again; or null.
    const Scene* same = nullptr;
    /// Overlaps of a scene that differs little; or null.
    KnownOverlaps* overlaps = nullptr;
    /// Cache of parsed geometry files, to which others are added; or null.
    MeshCache* meshes = nullptr;
};

/// Progress of reading a sweep: the number of points read, and of all.
using OnPointRead = std::function<void(std::size_t read, std::size_t points)>;

/// Reads a parsed document without [sweep]. @param no_light_policy  for runs without [time]; nights
/// in [time] are always allowed
[[nodiscard]] RunFile read_run_document(
    Node document,
    const std::string& name,
    InputFiles& files,
    const std::vector<Override>& overrides = {},
    const KnownScene& known = {},
    NoLightPolicy no_light_policy = NoLightPolicy::refused);

/// read_run_sweep() with another access to files.
[[nodiscard]] RunSweep read_run_sweep(
    const std::string& path,
    const std::vector<Override>& overrides,
    const FileAccess& access,
    const OnPointRead& on_point = {});

/// Sorts faults by the file's lines.
void sort_by_line(std::vector<Fault>& faults, const std::string& file);

/// Reads the points of a document, which may have a [sweep].
/// @param files  makes the reader of its files, once for each point
/// @throws InputError  with the faults of all points, each once
[[nodiscard]] RunSweep read_sweep_document(
    Node document,
    const std::string& name,
    std::function<InputFiles()> files,
    const std::vector<Override>& overrides = {},
    const OnPointRead& on_point = {});

// For programs that keep a scene and change the light on it, a document is read in two parts. Each
// ignores the keys of the other and [output], and refuses [sweep].

/// Function that adds organs to those of a document.
using AddOrgans = std::function<void(SceneBuilder&)>;

/// The scene of a document.
struct SceneOfRun {
    Scene scene;
    std::vector<GapFractionSpec> gap_fractions;
    std::vector<Warning> warnings;       ///< from the readers and from lint()
    std::vector<InputFile> inputs = {};  ///< files that were read, the run file first
};
/// The scene before it is built, without lint(): for programs that add organs later.
struct FrameOfRun {
    SceneBuilder builder;
    std::vector<GapFractionSpec> gap_fractions;
    std::vector<Warning> warnings;
};
/// @param vocabulary  of messages
/// @throws InputError  with all faults except those of building the scene
[[nodiscard]] FrameOfRun read_frame_document(
    const Node& document,
    const std::string& name,
    InputFiles& files,
    const AddOrgans& add_organs = {},
    const Vocabulary& vocabulary = {});
/// @param add_organs  adds organs after those of the document; may be empty
/// @param overlaps  of the previous scene, replaced by those of this one; or null
/// @throws InputError  with all faults at once
[[nodiscard]] SceneOfRun read_scene_document(
    const Node& document,
    const std::string& name,
    InputFiles& files,
    const AddOrgans& add_organs = {},
    KnownOverlaps* overlaps = nullptr,
    const Vocabulary& vocabulary = {});

/// Reads the scene of a run file ("-": standard input).
/// @throws InputError  with all faults at once
[[nodiscard]] SceneOfRun read_scene_of_run(const std::string& path);

/// The light and the options of a document.
struct LightOfRun {
    Sources sources;
    RunSpec spec;
    std::optional<TimeSeries> series;
    std::vector<std::string> source_notes;
    std::vector<Warning> warnings;
};
/// @param scene  of the same document
/// @throws InputError  with all faults at once
[[nodiscard]] LightOfRun read_light_document(
    const Node& document,
    const std::string& name,
    InputFiles& files,
    const Scene& scene,
    const Vocabulary& vocabulary = {});

}  // namespace quasimc

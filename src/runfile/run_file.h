#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/input_files.h"
#include "quasimc/run_file.h"
#include "text/document.h"

namespace quasimc {

/// Reads the text of a run file.
/// @param name   for messages
/// @param files  reads what the text names, and collects what was read
[[nodiscard]] RunFile read_run_text(
    std::string_view text,
    const std::string& name,
    InputFiles& files,
    const std::vector<Override>& overrides = {});

/// Whether no source has any light.
[[nodiscard]] bool is_dark(const Sources& sources);

/// What is to be said of a run without any light: its numbers are zeros.
enum class NoLightPolicy { refused, allowed };

class KnownOverlaps;
class MeshCache;

/// What is known of the scene of a document before it is read.
struct KnownScene {
    /// One with its organs, ground and cell: where lights, materials and settings alone differ,
    /// these are not read again. Or null.
    const Scene* same = nullptr;
    /// Of a scene that differs little; or null.
    KnownOverlaps* overlaps = nullptr;
    /// Geometry files that are parsed already, to which those that are not are added; or null.
    MeshCache* meshes = nullptr;
};

/// Called as the points of a sweep are read, with the number of those that are.
using OnPointRead = std::function<void(std::size_t read, std::size_t points)>;

/// The same from a document that is parsed already, and has no [sweep].
/// @param no_light_policy  of a run without [time]; nights of those with it are allowed
[[nodiscard]] RunFile read_run_document(
    Node document,
    const std::string& name,
    InputFiles& files,
    const std::vector<Override>& overrides = {},
    const KnownScene& known = {},
    NoLightPolicy no_light_policy = NoLightPolicy::refused);

/// read_run_sweep() of files that are reached otherwise.
[[nodiscard]] RunSweep read_run_sweep(
    const std::string& path,
    const std::vector<Override>& overrides,
    const FileAccess& access,
    const OnPointRead& on_point = {});

/// Puts faults into the order of the file's lines.
void sort_by_line(std::vector<Fault>& faults, const std::string& file);

/// Reads the points of a document, which may have a [sweep].
/// @param files  makes what reads the files that it names, once for each point
/// @throws InputError  with the faults of all points, each once
[[nodiscard]] RunSweep read_sweep_document(
    Node document,
    const std::string& name,
    std::function<InputFiles()> files,
    const std::vector<Override>& overrides = {},
    const OnPointRead& on_point = {});

// For programs that keep a scene and change the light on it, a document is read in two parts. Each
// passes over the keys of the other, and over [output], and refuses [sweep].

/// Adds organs to those of a document.
using AddOrgans = std::function<void(SceneBuilder&)>;

/// What a document says of what light falls on.
struct SceneOfRun {
    Scene scene;
    std::vector<Warning> warnings;  ///< of the readers and of lint()
};
/// The same before it is built, and without lint(): for programs that go on adding organs.
struct FrameOfRun {
    SceneBuilder builder;
    std::vector<Warning> warnings;
};
/// @throws InputError  with all faults at once, but for those that building finds
[[nodiscard]] FrameOfRun read_frame_document(
    const Node& document,
    const std::string& name,
    InputFiles& files,
    const AddOrgans& add_organs = {});
/// @param add_organs  adds more of them, behind those of the document; may be empty
/// @throws InputError  with all faults at once
[[nodiscard]] SceneOfRun read_scene_document(
    const Node& document,
    const std::string& name,
    InputFiles& files,
    const AddOrgans& add_organs = {});

/// What a document says of the light, and of how it is computed.
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
    const Node& document, const std::string& name, InputFiles& files, const Scene& scene);

}  // namespace quasimc

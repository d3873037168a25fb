#include "runfile/run_file.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "meshio/formats.h"

namespace quasimc {
namespace {

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

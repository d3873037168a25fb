#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_files.h"
#include "io/runfile/document.h"
#include "io/runfile/time_series.h"
#include "run/run.h"
#include "scene/scene.h"
#include "solvers/run_spec.h"

namespace quasimc {

/// Where results go; "-" is standard output.
struct OutputSpec {
    std::optional<std::string> csv, json;
    std::optional<std::string> days;  ///< sums over days, of a run with [time]
};

/// An option stated outside the run file.
struct Override {
    std::string key;    ///< of the table of options
    std::string text;   ///< its value
    std::string place;  ///< where it was stated, for messages: "--paths"
};

/// A run as a file states it, read and checked.
struct RunFile {
    std::string path;  ///< of the file, as given
    std::string title;
    Scene scene;
    Sources sources;  ///< with [time]: those that shine at all times
    RunSpec spec;
    std::optional<TimeSeries> series;  ///< of a run with [time]
    OutputSpec output;                 ///< paths from the folder of the run file resolved
    std::vector<InputFile> inputs;     ///< the run file first
    std::string folder;                ///< that the paths in the run file are relative to
    std::vector<std::string>
        source_notes;               ///< per source: name, kind, direction, irradiance in words
    std::vector<Warning> warnings;  ///< of the readers and of lint()
    Node document;                  ///< the run file, its [run] complete
};

/// The times to compute: those of [time] or else a single one, an instant, with the sources of the
/// run.
[[nodiscard]] std::vector<TimeStep> moments_of(const RunFile& run);

/// Reads a run file ("-": standard input).
/// @throws InputError  with all its faults at once
[[nodiscard]] RunFile read_run_file(
    const std::string& path, const std::vector<Override>& overrides = {});

/// Reads the text of a run file.
/// @param name   for messages
/// @param files  reads what the text names, and collects what was read
[[nodiscard]] RunFile read_run_text(
    std::string_view text,
    const std::string& name,
    InputFiles& files,
    const std::vector<Override>& overrides = {});

/// The same from a document that is parsed already.
[[nodiscard]] RunFile read_run_document(
    Node document,
    const std::string& name,
    InputFiles& files,
    const std::vector<Override>& overrides = {});

/// A run file with every option and its default, with comments, that can be run as it stands.
[[nodiscard]] std::string default_run_file();

}  // namespace quasimc

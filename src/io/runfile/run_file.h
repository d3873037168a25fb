#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_files.h"
#include "io/runfile/document.h"
#include "quasimc/file.h"

namespace quasimc {

/// Reads the text of a run file.
/// @param name   for messages
/// @param files  reads what the text names, and collects what was read
[[nodiscard]] RunFile read_run_text(
    std::string_view text,
    const std::string& name,
    InputFiles& files,
    const std::vector<Override>& overrides = {});

/// The same from a document that is parsed already, and has no [sweep].
/// @param base  a scene with the organs, ground and cell of the document: where lights, materials
///        and settings alone differ from those of the base, they are not read again
[[nodiscard]] RunFile read_run_document(
    Node document,
    const std::string& name,
    InputFiles& files,
    const std::vector<Override>& overrides = {},
    const Scene* base = nullptr);

/// Puts faults into the order of the file's lines.
void sort_by_line(std::vector<Fault>& faults, const std::string& file);

/// Reads the points of a document, which may have a [sweep].
/// @param files  makes what reads the files that it names, once for each point
/// @throws InputError  with the faults of all points, each once
[[nodiscard]] RunSweep read_sweep_document(
    Node document,
    const std::string& name,
    std::function<InputFiles()> files,
    const std::vector<Override>& overrides = {});

}  // namespace quasimc

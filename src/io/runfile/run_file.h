#pragma once

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

/// The same from a document that is parsed already.
[[nodiscard]] RunFile read_run_document(
    Node document,
    const std::string& name,
    InputFiles& files,
    const std::vector<Override>& overrides = {});

}  // namespace quasimc

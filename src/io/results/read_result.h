#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/runfile/run_file.h"

namespace quasimc {

/// The same from text.
/// @param name    for messages
/// @param folder  that of the result
[[nodiscard]] StoredRun read_result_text(
    const std::string& text,
    const std::string& name,
    const std::filesystem::path& folder,
    const InputFiles::Reader& reader = read_file,
    const std::vector<Override>& overrides = {});

}  // namespace quasimc

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/runfile/run_file.h"

namespace quasimc {

/// read_result_sweep() from text.
/// @param name    for messages
/// @param folder  that of the result
[[nodiscard]] StoredSweep read_result_text(
    const std::string& text,
    const std::string& name,
    const std::filesystem::path& folder,
    const InputFiles::Reader& reader = read_file,
    const std::vector<Override>& overrides = {});

}  // namespace quasimc

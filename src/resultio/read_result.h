#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "quasimc/result_file.h"
#include "runfile/run_file.h"

namespace quasimc {

/// read_result_sweep() from text.
/// @param name    for messages
/// @param folder  folder of the result
[[nodiscard]] StoredSweep read_result_text(
    const std::string& text,
    const std::string& name,
    const std::filesystem::path& folder,
    const FileAccess& access = {},
    const std::vector<Override>& overrides = {});

/// read_result_sweep() with another way to reach files.
[[nodiscard]] StoredSweep read_result_sweep(
    const std::string& path, const std::vector<Override>& overrides, const FileAccess& access);

}  // namespace quasimc

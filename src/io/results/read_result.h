#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/runfile/run_file.h"

namespace quasimc {

/// A run that was done before, read back from its JSON result.
struct StoredRun {
    RunFile run;  ///< its [output] is left out: a result is not overwritten by accident
    std::string organs_sha256;  ///< as write_json returned it
};

/// Reads a JSON result, and the files that its run was made from: those beside the result, or else
/// those at the places where they were.
/// @throws InputError  if it is no result, an input is gone or has changed, or the run has faults
[[nodiscard]] StoredRun read_result_file(
    const std::string& path, const std::vector<Override>& overrides = {});

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

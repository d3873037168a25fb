#pragma once

#include <span>
#include <string>

#include "io/runfile/run_file.h"
#include "quasimc/result.h"

namespace quasimc {

// What a result says beside its organs, as JSON objects, for the page of a run that goes on.

/// Of the run: files, settings, sources, warnings.
[[nodiscard]] std::string window_run_head(const RunFile& run);
/// Of the light at a time: method, rays, energy, groups.
[[nodiscard]] std::string window_light_head(const RunFile& run, const Result& result);
/// The same where there is no run file. @param bands  of the result
[[nodiscard]] std::string window_light_head(
    std::span<const Band> bands, const std::string& length_unit, const Result& result);

}  // namespace quasimc

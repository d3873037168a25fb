#pragma once

#include <span>
#include <string>
#include <string_view>

namespace quasimc {

/// In what the runs of two heads (json_head) differ, so far as it changes results: "run.paths: 4096
/// there, 8192 here"; "" if in nothing.
/// @param free  keys that may differ as well
[[nodiscard]] std::string difference_of_runs(
    const std::string& there, const std::string& here, std::span<const std::string_view> free = {});

}  // namespace quasimc

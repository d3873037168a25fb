#pragma once

#include <string>

namespace quasimc {

/// In what the runs of two heads (json_head) differ, so far as it changes results: "run.paths: 4096
/// there, 8192 here"; "" if in nothing.
[[nodiscard]] std::string difference_of_runs(const std::string& there, const std::string& here);

}  // namespace quasimc

#pragma once

#include <span>
#include <string>
#include <string_view>

namespace quasimc {

/// The first difference between two heads (json_head) that changes results: "run.paths: 4096 there,
/// 8192 here"; "" without one.
/// @param free  further keys that may differ
[[nodiscard]] std::string difference_of_runs(
    const std::string& there, const std::string& here, std::span<const std::string_view> free = {});

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/result.h"

namespace quasimc {

/// What a JSON result says of its rounds; none if it was one round.
/// @param point  of a sweep
/// @param time   of a run with [time]: the beginning of the name of a moment; else ""
/// @param path   for messages
/// @throws InputError  if it is not JSON, or lacks the point or the time
[[nodiscard]] std::vector<RoundErrors> read_rounds(
    const std::string& text,
    const std::string& path,
    std::optional<std::size_t> point,
    const std::string& time);

}  // namespace quasimc

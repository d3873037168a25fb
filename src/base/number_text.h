#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace quasimc {

/// "1 organ", "2 organs": a number with its noun.
/// @param plural  default: the noun with an s
[[nodiscard]] std::string counted(
    std::uint64_t count, std::string_view noun, std::string_view plural = {});

/// A standard error with two significant digits if it begins with 1 or 2, else one: 0.022, 400,
/// 1.2e+07.
[[nodiscard]] std::string error_text(double error);

/// The value with a fixed number of decimals. A zero has no sign.
[[nodiscard]] std::string with_decimals(double value, int decimals);

}  // namespace quasimc

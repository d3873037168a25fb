#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace quasimc {

/// "1 organ", "2 organs": a number with its noun.
/// @param plural  default: the noun with an s
[[nodiscard]] std::string counted(
    std::uint64_t count, std::string_view noun, std::string_view plural = {});

/// A standard error with two significant digits: 0.022, 430, 1.2e+07.
[[nodiscard]] std::string two_digits(double error);

/// The value with a fixed number of decimals. A zero has no sign.
[[nodiscard]] std::string with_decimals(double value, int decimals);

}  // namespace quasimc

#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace quasimc {

/// Parses all of `text` as a number ("1", "+2.5", "1e-3"; also "nan" and "inf", which callers must
/// check). Empty if it is none, or out of the range of double precision. Independent of the locale.
[[nodiscard]] std::optional<double> parse_real(std::string_view text);

/// Parses all of `text` as an integer; empty if it is none or exceeds 64 bits.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text);

/// Converts an integral number; empty if it is not integral, or not exact in double precision.
[[nodiscard]] inline std::optional<std::int64_t> whole_number(double x) {
    constexpr double kExact = 9007199254740992;  // 2^53
    const bool is_whole = std::abs(x) <= kExact && x == std::floor(x);
    return is_whole ? std::optional(static_cast<std::int64_t>(x)) : std::nullopt;
}

/// A coordinate of a unit vector for output: values within rounding of 0 become 0.
[[nodiscard]] inline double without_rounding(double x) {
    constexpr double kRounding = 1e-12;
    return std::abs(x) < kRounding ? 0 : x;
}

}  // namespace quasimc

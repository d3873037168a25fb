#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace quasimc {

/// The whole of `text` as a number ("1", "+2.5", "1e-3", also "nan" and "inf": whoever asks must
/// check), or nothing, also when it is out of the range of double precision. Never depends on the
/// locale.
[[nodiscard]] std::optional<double> parse_real(std::string_view text);

/// The whole of `text` as an integer, or nothing (also when it does not fit 64 bits).
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text);

/// The integer that a number is; nothing if it is none, or so large that it might stand for others.
[[nodiscard]] inline std::optional<std::int64_t> whole_number(double x) {
    constexpr double kExact = 9007199254740992;  // 2^53
    const bool is_whole = std::abs(x) <= kExact && x == std::floor(x);
    return is_whole ? std::optional(static_cast<std::int64_t>(x)) : std::nullopt;
}

/// A coordinate of a unit vector, to be shown: what is but rounding is 0.
[[nodiscard]] inline double without_rounding(double x) {
    constexpr double kRounding = 1e-12;
    return std::abs(x) < kRounding ? 0 : x;
}

}  // namespace quasimc

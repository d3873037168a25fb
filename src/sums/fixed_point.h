#pragma once

#include <cstdint>

#include "sums/exact_bins.h"

namespace quasimc {

/// Amounts of light in 64-bit fixed point: sums are exact, so their order can't matter. 2^28 quanta
/// a unit.
inline constexpr double kFixedOne = ExactBins::kQuantaPerUnit;

/// A single amount is below this many units (2^62 quanta).
inline constexpr double kLargestAmount = 17179869184.0;

/// @throws InputError  "light too strong to be summed": an amount that is no number, or too large
[[noreturn]] void refuse_amount(double amount);

/// `amount` >= 0 in fixed point, rounded to nearest.
/// @throws InputError  if it is no number below kLargestAmount
inline std::int64_t to_fixed(double amount) {
    if (!(amount < kLargestAmount)) [[unlikely]] {
        refuse_amount(amount);
    }
    // Not lround: truncation is one instruction, and right for amounts that are never negative.
    return static_cast<std::int64_t>(
        amount * kFixedOne + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}

inline double from_fixed(std::int64_t amount) {
    return static_cast<double>(amount) / kFixedOne;
}

}  // namespace quasimc

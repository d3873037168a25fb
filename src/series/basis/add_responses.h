#pragma once

#include <cstddef>

namespace quasimc {

/// Number of responses and of sums that are processed together.
inline constexpr std::size_t kAddedAtOnce = 4;

/// Adds several responses to several sums, compiled for a vector unit:
/// to[s][i] += factors[k * sums + s] * from[k][i], over all k, four of them at a time, for all
/// i < `count`. `responses` and `sums` are multiples of kAddedAtOnce.
using AddResponses = void (*)(
    const float* const* from,
    const double* factors,
    std::size_t responses,
    std::size_t count,
    std::size_t sums,
    double* const* to);

/// The loop for the vector unit of this machine. All variants compute the same bits.
[[nodiscard]] AddResponses best_add_responses();

}  // namespace quasimc

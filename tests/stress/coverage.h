#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stress/judge.h"

namespace quasimc::stress {

/// How often the 95 % intervals of one way hold what all ways together have for the truth.
struct Coverage {
    Way way = Way::light_tracing;
    double held = 1;   ///< share of the numbers, mean over the seeds
    double error = 0;  ///< its standard error, from the seeds
    std::size_t numbers = 0;
    std::size_t worst = 0;  ///< of these the number that is held least often
    double worst_held = 1;  ///< how often

    /// Below nine in ten for certain: more than five standard errors.
    [[nodiscard]] bool is_finding() const { return numbers > 0 && held + 5 * error < .9; }
};

/// Computes a case with `seeds` seeds in each of the program's ways. The truth of a number is the
/// mean of the way that knows it best of the others, where that is sharp enough to tell.
[[nodiscard]] std::vector<Coverage> coverage_of(
    const Case& it, const Effort& effort, unsigned seeds, std::uint64_t number);

}  // namespace quasimc::stress

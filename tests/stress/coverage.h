#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stress/judge.h"

namespace quasimc::stress {

/// Coverage of the 95 % intervals of one way, with the best estimate of all ways as truth.
struct Coverage {
    Way way = Way::light_tracing;
    double held = 1;   ///< fraction of the numbers, mean over the seeds
    double error = 0;  ///< its standard error, from the seeds
    std::size_t numbers = 0;
    std::size_t worst = 0;  ///< the number with the lowest coverage
    double worst_held = 1;  ///< its coverage

    /// Whether the coverage is below 0.9 by more than five standard errors.
    [[nodiscard]] bool is_finding() const { return numbers > 0 && held + 5 * error < .9; }
};

/// Computes a case with `seeds` seeds in each of the program's ways. The truth of a number is the
/// mean of the most precise other way, if it is precise enough.
[[nodiscard]] std::vector<Coverage> coverage_of(
    const Case& it, const Effort& effort, unsigned seeds, std::uint64_t number);

}  // namespace quasimc::stress

#pragma once

#include <string>
#include <vector>

#include "stress/ways.h"

namespace quasimc::stress {

/// Impossible results for any scene: numbers that are not finite, negative fluxes, intervals
/// without their mean, an energy budget that does not close.
[[nodiscard]] std::vector<std::string> impossible_numbers(
    const Answer& answer, const std::vector<std::string>& names);

/// Whether two results of a case have the same bits.
[[nodiscard]] bool same_bits(const Answer& a, const Answer& b);

/// Faults that need no statistics: results that depend on the number of threads, and `auto`
/// differing from the method that it names. Computes the case three more times.
[[nodiscard]] std::vector<std::string> faults_of_identity(const Case& it, const Effort& effort);

}  // namespace quasimc::stress

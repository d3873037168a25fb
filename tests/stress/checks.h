#pragma once

#include <string>
#include <vector>

#include "stress/ways.h"

namespace quasimc::stress {

/// What an answer says that can't be, whatever the scene: numbers that are not finite, negative
/// fluxes, intervals that don't hold their mean, an energy budget that stays open.
[[nodiscard]] std::vector<std::string> impossible_numbers(
    const Answer& answer, const std::vector<std::string>& names);

/// Whether two results of a case have the same bits.
[[nodiscard]] bool same_bits(const Answer& a, const Answer& b);

/// Faults of the case that no statistics is needed for: threads that change numbers, `auto` that
/// differs from the method it names. It computes the case three times more.
[[nodiscard]] std::vector<std::string> faults_of_identity(const Case& it, const Effort& effort);

}  // namespace quasimc::stress

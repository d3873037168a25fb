#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "stress/ways.h"

namespace quasimc::stress {

/// Two ways that say different things of one number.
struct Disagreement {
    std::size_t number = 0;
    Way a = Way::light_tracing, b = Way::light_tracing;
    double chance = 1;  ///< of so large a difference, or a larger one, if both are right
    std::string words;
};

/// The chance that two numbers differ by so much or more if both ways are right: of Student's t
/// with the degrees of freedom of Welch (1947), where both have errors; of finding nothing, where
/// one has found nothing and says how much there may be at most (rule of three: three finds).
/// @param slack  a difference that never counts
[[nodiscard]] double chance_of(
    const Number& a, double freedom_a, const Number& b, double freedom_b, double slack = 0);

/// By how much two numbers of a case may differ without a fault: what slips through, and rounding.
[[nodiscard]] double slack_of(const Case& it, std::size_t number, double mean);

/// The same of two answers. What organs, or the ground, absorb in all may differ by what each of
/// them may: rounding has one sign for all rays that meet a triangle.
[[nodiscard]] double slack_between(
    const Case& it, std::size_t number, const Answer& a, const Answer& b);

/// All pairs of ways, number by number, whose chance is below `level`.
[[nodiscard]] std::vector<Disagreement> disagreements(
    const Case& it, const std::vector<Answer>& answers, double level);

/// How many comparisons those are.
[[nodiscard]] std::size_t count_comparisons(const std::vector<Answer>& answers);

}  // namespace quasimc::stress

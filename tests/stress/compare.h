#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "stress/ways.h"

namespace quasimc::stress {

/// Two ways with different results for one number.
struct Disagreement {
    std::size_t number = 0;
    Way a = Way::light_tracing, b = Way::light_tracing;
    double p_value = 1;  ///< probability of at least this difference if both are right
    std::string words;
};

/// The p-value of the difference of two numbers: by Student's t with the degrees of freedom of
/// Welch (1947) if both have errors; the probability of zero contributions if one has none and only
/// an upper bound (rule of three: three contributions).
/// @param slack  a difference that never counts
[[nodiscard]] double p_value_of(
    const Number& a, double freedom_a, const Number& b, double freedom_b, double slack = 0);

/// Allowed difference of two numbers of a case, due to slivers and rounding.
[[nodiscard]] double slack_of(const Case& it, std::size_t number, double mean);

/// slack_of() for two answers. Totals of organs or of the ground may differ by the sum over all of
/// them, because rounding has one sign for all rays that hit a triangle.
[[nodiscard]] double slack_between(
    const Case& it, std::size_t number, const Answer& a, const Answer& b);

/// All pairs of ways, number by number, with a p-value below `level`.
[[nodiscard]] std::vector<Disagreement> disagreements(
    const Case& it, const std::vector<Answer>& answers, double level);

/// Number of these comparisons.
[[nodiscard]] std::size_t count_comparisons(const std::vector<Answer>& answers);

}  // namespace quasimc::stress

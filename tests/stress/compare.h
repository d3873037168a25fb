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

/// Relative error that is left to rounding: windows of beams are larger than the scene by 2^-20
/// each way, and triangles are traced in single precision.
inline constexpr double kRounding = 5e-6;

/// The chance that two numbers differ by so much or more if both ways are right: of Student's t
/// with the degrees of freedom of Welch (1947), where both have errors; of finding nothing, where
/// one has found nothing and says how much there may be at most (rule of three: three finds).
/// @param slip  a difference that never counts
[[nodiscard]] double chance_of(
    const Number& a, double freedom_a, const Number& b, double freedom_b, double slip = 0);

/// All pairs of ways, number by number, whose chance is below `level`.
[[nodiscard]] std::vector<Disagreement> disagreements(
    const Case& it, const std::vector<Answer>& answers, double level);

/// How many comparisons those are.
[[nodiscard]] std::size_t count_comparisons(const std::vector<Answer>& answers);

}  // namespace quasimc::stress

#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace quasimc::test {
namespace {

/// Whether a measured difference is 0 but for `rounding`; `words` tell of what.
::testing::AssertionResult is_zero(
    const Measured& difference,
    double rounding,
    double resolution,
    double level,
    const std::string& words) {
    if (difference.replicates < 2) {
        return ::testing::AssertionFailure() << words << ": fewer than two replicates, no error";
    }
    const double half =
        student_t_quantile(1 - level / 2, difference.replicates - 1) * difference.standard_error;
    if (!(half <= resolution)) {
        return ::testing::AssertionFailure()
               << words << ": the error is too large to tell: half-width " << half
               << ", resolution asked for " << resolution;
    }
    if (!(std::abs(difference.mean) <= half + rounding)) {
        return ::testing::AssertionFailure()
               << words << ": the difference " << difference.mean << " is beyond the half-width "
               << half << " (" << std::abs(difference.mean) / difference.standard_error
               << " standard errors)";
    }
    return ::testing::AssertionSuccess() << words << ", half-width " << half;
}

double rounding_of(double a, double b) {
    return 1e-12 * std::max(std::abs(a), std::abs(b));
}

}  // namespace

Measured measured(std::span<const double> values) {
    return measured(estimate_mean(values), static_cast<unsigned>(values.size()));
}

Measured measured(const Estimate& estimate, unsigned replicates) {
    return {estimate.mean, estimate.standard_error, replicates};
}

Measured measured_fraction(double yes, double tries, double expected) {
    return {
        yes / tries, std::sqrt(expected * (1 - expected) / tries), static_cast<unsigned>(tries)};
}

::testing::AssertionResult agrees(
    const Measured& m, double expected, double resolution, double level) {
    return is_zero(
        {m.mean - expected, m.standard_error, m.replicates}, rounding_of(m.mean, expected),
        resolution, level, fmt::format("measured {}, expected {}", m.mean, expected));
}

::testing::AssertionResult agrees(
    const Measured& a, const Measured& b, double resolution, double level) {
    // The smaller number of degrees of freedom is on the safe side (Welch 1947).
    const Measured difference{
        a.mean - b.mean, std::hypot(a.standard_error, b.standard_error),
        std::min(a.replicates, b.replicates)};
    return is_zero(
        difference, rounding_of(a.mean, b.mean), resolution, level,
        fmt::format("measured {} and {}", a.mean, b.mean));
}

double sidak_level(double family_level, unsigned tests) {
    return -std::expm1(std::log1p(-family_level) / tests);
}

}  // namespace quasimc::test

#pragma once

#include <span>

#include <gtest/gtest.h>

#include "sums/statistics.h"

namespace quasimc::test {

/// The chance that a correct program fails one test, were its seed drawn anew.
inline constexpr double kLevel = 1e-6;

/// A number measured by independent replicates, at least two.
struct Measured {
    double mean = 0;
    double standard_error = 0;
    unsigned replicates = 0;
};

/// The mean of `values`, one per replicate.
[[nodiscard]] Measured measured(std::span<const double> values);

/// An estimate of a run with that many replicates.
[[nodiscard]] Measured measured(const Estimate& estimate, unsigned replicates);

/// The fraction of `tries` independent yes-or-no experiments that said yes, to be compared with
/// `expected`, 0 < expected < 1 (normal approximation: tries * expected and tries * (1 - expected)
/// should be 50 or more).
[[nodiscard]] Measured measured_fraction(double yes, double tries, double expected);

/// Whether a measurement is as near to the expected value as its standard error promises (Student's
/// t at `level`, and a relative 1e-12 for rounding), and sharp enough to tell: fails as well if the
/// half-width of that interval exceeds `resolution`.
///
///     EXPECT_TRUE(agrees(measured(values), 2.0 / 3, 1e-3));
[[nodiscard]] ::testing::AssertionResult agrees(
    const Measured& m, double expected, double resolution, double level = kLevel);

/// The same for two independent measurements of one number.
[[nodiscard]] ::testing::AssertionResult agrees(
    const Measured& a, const Measured& b, double resolution, double level = kLevel);

/// The level for each of `tests` independent tests, so that the chance of any failure is
/// `family_level` (Sidak 1967).
[[nodiscard]] double sidak_level(double family_level, unsigned tests);

}  // namespace quasimc::test

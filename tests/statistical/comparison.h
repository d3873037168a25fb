#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "quasimc/result.h"

namespace quasimc::test {

/// State of a side without contributions: dark, or lit too little to be sampled.
enum class Unseen { dark, few_contributions };

/// Compares pairs of independent runs of the same scene, of kReplicates replicates each. The pairs
/// of one object share the level of one test.
class Comparison {
  public:
    explicit Comparison(unsigned pairs, Unseen unseen = Unseen::dark)
        : pairs_(pairs), unseen_(unseen) {}

    /// Whether two runs agree on the absorbed light of all organs and of the ground, in each band.
    /// With Unseen::few_contributions a run without contributions may have missed as much as its
    /// interval allows.
    [[nodiscard]] ::testing::AssertionResult totals_agree(const Result& a, const Result& b);

    /// Whether they agree on the light on each side of each organ, in each band. With
    /// Unseen::few_contributions a side with an unknown error is not compared, and has an infinite
    /// width.
    [[nodiscard]] ::testing::AssertionResult organs_agree(const Result& a, const Result& b);

    /// Whether nine in ten of the comparisons so far were precise: half-widths of the differences
    /// of the totals at most `totals` of the emitted light, those of the organs' sides at most
    /// `organs` of their mean. (Nine: light sampled from organs at a glossy leaf at grazing angles
    /// is a rare but large contribution, so that some errors are large.)
    [[nodiscard]] ::testing::AssertionResult are_sharp(double totals, double organs) const;

    /// Whether the mean square of the organs' differences, in units of their standard errors, is
    /// that of Student's t: at most 31/29.
    /// @param resolution  of that average, from the differences between the pairs
    [[nodiscard]] ::testing::AssertionResult scatter_is_that_of_errors(double resolution) const;

  private:
    unsigned pairs_;
    Unseen unseen_;
    std::vector<double> total_widths_, organ_widths_;  ///< relative half-widths
    std::vector<double> mean_squares_;                 ///< per pair of runs
};

}  // namespace quasimc::test

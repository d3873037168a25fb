#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "quasimc/result.h"

namespace quasimc::test {

/// What a side was that a run has not seen: dark, or lit by less than it could find.
enum class Unseen { dark, few_contributions };

/// Compares pairs of independent runs of the same scene, of kReplicates replicates each. The pairs
/// of one object share the level of one test.
class Comparison {
  public:
    explicit Comparison(unsigned pairs, Unseen unseen = Unseen::dark)
        : pairs_(pairs), unseen_(unseen) {}

    /// Whether two runs agree on what all organs and what the ground absorb, in each band. With
    /// Unseen::few_contributions a run that has found nothing may have missed what its interval
    /// says.
    [[nodiscard]] ::testing::AssertionResult totals_agree(const Result& a, const Result& b);

    /// Whether they agree on what falls on each side of each organ, in each band. With
    /// Unseen::few_contributions a side of which a run says that it can't tell is not compared, and
    /// has an infinite width.
    [[nodiscard]] ::testing::AssertionResult organs_agree(const Result& a, const Result& b);

    /// Whether nine in ten of the comparisons so far could tell: half-widths of the differences of
    /// the totals at most `totals` of the light emitted, those of the organs' sides at most
    /// `organs` of the mean over them. (Nine: light sampled from the organs at a glossy leaf that
    /// is seen edge-on is a rare but large amount, so that some errors are large.)
    [[nodiscard]] ::testing::AssertionResult are_sharp(double totals, double organs) const;

    /// Whether the squares of the organs' differences, in units of their standard errors, are on
    /// average what Student's t gives: at most 31/29.
    /// @param resolution  of that average, from the differences between the pairs
    [[nodiscard]] ::testing::AssertionResult scatter_is_that_of_errors(double resolution) const;

  private:
    unsigned pairs_;
    Unseen unseen_;
    std::vector<double> total_widths_, organ_widths_;  ///< relative half-widths
    std::vector<double> mean_squares_;                 ///< per pair of runs
};

}  // namespace quasimc::test

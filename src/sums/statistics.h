#pragma once

#include <span>

#include "quasimc/sums.h"

namespace quasimc {

/// Of one number at least.
[[nodiscard]] double mean_of(std::span<const double> values);

/// Mean, standard error and 95 % Student t-interval of the mean of `values`, one per replicate (at
/// least one; with one replicate error and interval are NaN).
[[nodiscard]] Estimate estimate_mean(std::span<const double> values);

/// The ratio of two means, `a[i]` and `b[i]` from the same replicate, with the standard error of
/// the delta method: the errors of numerator and denominator are correlated, mostly to the good.
/// NaN where the denominator is 0.
[[nodiscard]] Estimate estimate_ratio(std::span<const double> a, std::span<const double> b);

/// The estimate of an amount that can't be negative. Its interval is cut at 0, which does not
/// change how often it contains the truth. An interval wholly below 0 is replaced by one that
/// begins at 0 and is as wide as its upper half. The mean does not change.
[[nodiscard]] Estimate not_negative(const Estimate& e);

/// The estimate of an amount that can't be above `most`. Its interval is cut there, which does not
/// change how often it contains the truth. An interval wholly above is replaced by one that ends at
/// the limit and is as wide as its lower half. The mean does not change: it may lie above the limit
/// by chance, or it would be biased. If `most` is 0, the estimate is exactly 0.
[[nodiscard]] Estimate not_above(const Estimate& e, double most);

/// An amount of which nothing was seen in `events` independent tries, each of which could have
/// brought `most`: 0, with the upper 95 % limit 3 most / events (rule of three: Hanley and
/// Lippman-Hand 1983).
[[nodiscard]] Estimate estimate_unseen(double events, double most);

/// The mean of amounts that independent replicates found; where all of them are 0 and a single find
/// would have brought `value_per_contribution` > 0 to one of them, the bound of estimate_unseen().
/// Nothing of the interval is below 0.
[[nodiscard]] Estimate estimate_seen_or_bound(
    std::span<const double> values, double value_per_contribution);

/// What the samples of a run may have overlooked: by how much one find more, or one less, would
/// change the mean of the replicates. 0 where there can be none.
struct ContributionSize {
    double more = 0, less = 0;
};

/// Of each of the two the larger one.
[[nodiscard]] ContributionSize larger(const ContributionSize& a, const ContributionSize& b);

/// The mean of amounts that independent replicates found, each of which rests on finds of a size
/// that is known. The variance is that of the replicates and of one find more, which is what a
/// number of finds leaves open that is Poisson distributed (k finds: (k + 1) squares; the posterior
/// of an even prior). The 95 % interval reaches hypot(t s, 3 finds) to either side: of no finds the
/// rule of three, of many Student's t. Where no find was made and `find.more` > 0: that of
/// estimate_unseen(). Nothing of the interval is below 0. See docs/theory/statistics.md.
[[nodiscard]] Estimate estimate_contributions(
    std::span<const double> values, const ContributionSize& find);

/// An estimate that rests on finds, of which its standard error and interval do not tell yet: both
/// widened as those of estimate_contributions() are.
[[nodiscard]] Estimate widened(const Estimate& e, const ContributionSize& find);

/// The p-quantile of Student's t-distribution, 0 < p < 1, df >= 1.
[[nodiscard]] double student_t_quantile(double p, unsigned df);

/// The probability that a number of the F distribution exceeds f >= 0; degrees of freedom >= 1, of
/// numerator and denominator, need not be whole. f = t^2 with one degree above: Student's t of
/// either sign. Abramowitz and Stegun 26.6.2.
[[nodiscard]] double f_tail(double f, double above, double below);

/// The half-width of the 95 % interval in standard errors: the 0.975-quantile, df >= 1.
[[nodiscard]] double interval_quantile(unsigned df);

}  // namespace quasimc

#pragma once

#include <span>
#include <vector>

#include "quasimc/sums.h"

namespace quasimc {

/// Mean of at least one number.
[[nodiscard]] double mean_of(std::span<const double> values);

/// Mean, standard error and 95 % Student t-interval of the mean of `values`, one per replicate (at
/// least one; with one replicate error and interval are NaN).
[[nodiscard]] Estimate estimate_mean(std::span<const double> values);

/// The ratio of two means, `a[i]` and `b[i]` from the same replicate, with the standard error of
/// the delta method: the errors of numerator and denominator are correlated. NaN if the denominator
/// is 0.
[[nodiscard]] Estimate estimate_ratio(std::span<const double> a, std::span<const double> b);

/// The estimate of an amount that can't be negative. Its interval is cut at 0, which does not
/// change how often it contains the truth. An interval wholly below 0 is replaced by one that
/// begins at 0 and is as wide as its upper half. The mean does not change.
[[nodiscard]] Estimate not_negative(const Estimate& e);

/// The estimate of an amount that can't be above `most`. Its interval is cut there, which does not
/// change how often it contains the truth. An interval wholly above is replaced by one that ends at
/// the limit and is as wide as its lower half. The mean does not change and may be above the limit
/// by chance: otherwise it would be biased. If `most` is 0, the estimate is exactly 0.
[[nodiscard]] Estimate not_above(const Estimate& e, double most);

/// An amount with zero contributions in `events` independent samples, each of at most `most`: 0,
/// with the upper 95 % limit 3 most / events (rule of three: Hanley and Lippman-Hand 1983).
[[nodiscard]] Estimate estimate_unseen(double events, double most);

/// The mean of the amounts of independent replicates. If all of them are 0 and a single
/// contribution to one of them would be `value_per_contribution` > 0: estimate_unseen(). The
/// interval is not below 0.
[[nodiscard]] Estimate estimate_seen_or_bound(
    std::span<const double> values, double value_per_contribution);

/// The size of a contribution: the change of the mean of the replicates by one contribution more,
/// or one less. 0 if there can be none.
struct ContributionSize {
    double more = 0, less = 0;

    friend ContributionSize operator*(const ContributionSize& size, double factor) {
        return {size.more * factor, size.less * factor};
    }
};

/// The larger one of each of the two.
[[nodiscard]] ContributionSize larger(const ContributionSize& a, const ContributionSize& b);

/// The size where either of two contributions may be missing: both in quadrature.
[[nodiscard]] ContributionSize both(const ContributionSize& a, const ContributionSize& b);

/// The mean of the amounts of independent replicates, which are sums of contributions of known
/// size. The variance is that of the replicates plus that of one more contribution, for the Poisson
/// distribution of a low number of contributions (k contributions: (k + 1) squares; the posterior
/// of a uniform prior). The 95 % interval reaches hypot(t s, 3 contributions) to either side: the
/// rule of three for none, Student's t for many. Without contributions and with `size.more` > 0:
/// estimate_unseen(). The interval is not below 0. See docs/theory/statistics.md.
[[nodiscard]] Estimate estimate_contributions(
    std::span<const double> values, const ContributionSize& size);

/// An estimate from contributions whose size its standard error and interval do not include yet:
/// both widened as in estimate_contributions().
[[nodiscard]] Estimate widened(const Estimate& e, const ContributionSize& size);

/// The ratio of an amount, the sum of contributions of known size, and a whole, from the same
/// replicates: the error of estimate_ratio(), widened as in estimate_contributions(). Unknown if
/// the whole is not above 0.
/// @param one  a contribution to the amount changes the ratio by one / the mean of the whole
[[nodiscard]] Estimate estimate_share(
    std::span<const double> amount, std::span<const double> whole, const ContributionSize& one);

/// Numbers of any sign, with their deviations in each replicate.
struct SignedNumbers {
    std::span<const double> means;
    std::span<const double> deviations;       ///< [replicate * numbers + number]
    std::span<const ContributionSize> sizes;  ///< one contribution
};

/// Their estimates from the scatter of the deviations, widened by the size of a contribution.
/// Intervals have no bounds; without any deviation the error is that of one contribution.
/// @param threads  at least 1
[[nodiscard]] std::vector<Estimate> estimate_signed(const SignedNumbers& numbers, unsigned threads);

/// The p-quantile of Student's t-distribution, 0 < p < 1, df >= 1.
[[nodiscard]] double student_t_quantile(double p, unsigned df);

/// The probability that a number of the F distribution exceeds f >= 0; degrees of freedom >= 1, of
/// numerator and denominator, need not be whole. f = t^2 with one degree above: Student's t of
/// either sign. Abramowitz and Stegun 26.6.2.
[[nodiscard]] double f_tail(double f, double above, double below);

/// The half-width of the 95 % interval in standard errors: the 0.975-quantile, df >= 1.
[[nodiscard]] double interval_quantile(unsigned df);

}  // namespace quasimc

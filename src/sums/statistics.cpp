#include "sums/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "base/checks.h"
#include "base/parallel.h"

namespace quasimc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Estimate with_interval(double mean, double standard_error, std::size_t replicates) {
    const double half = interval_quantile(static_cast<unsigned>(replicates - 1)) * standard_error;
    return {mean, standard_error, mean - half, mean + half};
}

/// A symmetric estimate with the error of one contribution more or less.
Estimate reaching(const Estimate& e, const ContributionSize& size) {
    const double half = e.ci95_high - e.mean;
    return {
        e.mean, std::hypot(e.standard_error, std::max(size.more, size.less)),
        e.mean - std::hypot(half, 3 * size.less), e.mean + std::hypot(half, 3 * size.more)};
}

/// Standard errors of `size` columns from `first` on. @param deviations  [replicate * count +
/// column]
std::vector<double> errors_of(
    std::span<const double> deviations, std::size_t count, std::size_t first, std::size_t size) {
    const std::size_t replicates = deviations.size() / count;
    const auto n = static_cast<double>(replicates);
    std::vector<double> means(size), squares(size, replicates < 2 ? kNan : 0);
    for (std::size_t r = 0; r < replicates; ++r) {
        for (std::size_t i = 0; i < size; ++i) {
            means[i] += deviations[r * count + first + i] / n;
        }
    }
    for (std::size_t r = 0; r < replicates; ++r) {
        for (std::size_t i = 0; i < size; ++i) {
            const double x = deviations[r * count + first + i] - means[i];
            squares[i] += x * x;
        }
    }
    for (double& square : squares) {
        square = std::sqrt(square / (n - 1) / n);
    }
    return squares;
}

}  // namespace

double mean_of(std::span<const double> values) {
    double sum = 0;
    for (const double x : values) {
        sum += x;
    }
    return sum / static_cast<double>(values.size());
}

Estimate estimate_seen_or_bound(std::span<const double> values, double value_per_contribution) {
    const auto is_zero = [](double x) { return x == 0; };
    if (value_per_contribution > 0 && std::all_of(values.begin(), values.end(), is_zero)) {
        return estimate_unseen(static_cast<double>(values.size()), value_per_contribution);
    }
    return not_negative(estimate_mean(values));
}

ContributionSize larger(const ContributionSize& a, const ContributionSize& b) {
    return {std::max(a.more, b.more), std::max(a.less, b.less)};
}

ContributionSize both(const ContributionSize& a, const ContributionSize& b) {
    // Usually one of the two is zero.
    const auto sum = [](double x, double y) { return x == 0 ? y : y == 0 ? x : std::hypot(x, y); };
    return {sum(a.more, b.more), sum(a.less, b.less)};
}

Estimate estimate_contributions(std::span<const double> values, const ContributionSize& size) {
    const Estimate e =
        estimate_seen_or_bound(values, size.more * static_cast<double>(values.size()));
    return widened(e, size);
}

Estimate widened(const Estimate& e, const ContributionSize& size) {
    if (!std::isfinite(e.standard_error) || (size.more == 0 && size.less == 0)) {
        return e;
    }
    return not_negative(reaching(e, size));
}

Estimate estimate_share(
    std::span<const double> amount, std::span<const double> whole, const ContributionSize& one) {
    const double mean = whole.empty() ? 0 : mean_of(whole);
    if (!(mean > 0)) {
        return kUnknownEstimate;
    }
    const ContributionSize size = one * (1 / mean);
    const bool is_dark = std::ranges::all_of(amount, [](double x) { return x == 0; });
    return is_dark ? estimate_contributions(amount, size)
                   : widened(not_negative(estimate_ratio(amount, whole)), size);
}

std::vector<Estimate> estimate_signed(const SignedNumbers& numbers, unsigned threads) {
    const std::size_t count = numbers.means.size();
    EXPECT(count > 0 && numbers.deviations.size() % count == 0 && numbers.sizes.size() == count);
    const std::size_t replicates = numbers.deviations.size() / count;
    std::vector<Estimate> all(count);
    constexpr std::size_t kPerBlock = 256;
    parallel_blocks(
        (count + kPerBlock - 1) / kPerBlock, threads, [&](std::uint64_t block, unsigned) {
            const std::size_t first = block * kPerBlock, size = std::min(kPerBlock, count - first);
            const std::vector<double> errors = errors_of(numbers.deviations, count, first, size);
            for (std::size_t i = first; i < first + size; ++i) {
                all[i] = reaching(
                    with_interval(numbers.means[i], errors[i - first], replicates),
                    numbers.sizes[i]);
            }
        });
    return all;
}

Estimate not_negative(const Estimate& e) {
    const double high = e.ci95_high < 0 ? e.ci95_high - e.mean : e.ci95_high;
    const bool is_below = e.ci95_low < 0 || (std::isnan(e.ci95_low) && e.mean < 0);
    return {e.mean, e.standard_error, is_below ? 0 : e.ci95_low, high};
}

double student_t_quantile(double p, unsigned df) {
    EXPECT(p > 0 && p < 1 && df >= 1);
    return boost::math::quantile(boost::math::students_t(df), p);
}

double f_tail(double f, double above, double below) {
    EXPECT(f >= 0 && above > 0 && below > 0);
    if (std::isinf(f)) {
        return 0;
    }
    return boost::math::cdf(boost::math::complement(boost::math::fisher_f(above, below), f));
}

double interval_quantile(unsigned df) {
    // From a table, as there are millions of estimates.
    static const auto table = [] {
        std::array<double, 64> quantiles{};
        for (unsigned i = 1; i < quantiles.size(); ++i) {
            quantiles[i] = student_t_quantile(0.975, i);
        }
        return quantiles;
    }();
    return df < table.size() ? table[df] : student_t_quantile(0.975, df);
}

Estimate not_above(const Estimate& e, double most) {
    if (most == 0 && e.mean == 0) {
        return {};
    }
    if (std::isnan(e.ci95_high) && e.mean > most) {  // in one replicate the limit alone is known
        return {e.mean, e.standard_error, e.ci95_low, most};
    }
    // An interval wholly above the limit has missed the value: the new one has its width below the
    // limit.
    const double low = e.ci95_low > most ? std::max(0.0, most - (e.mean - e.ci95_low)) : e.ci95_low;
    return {e.mean, e.standard_error, low, e.ci95_high > most ? most : e.ci95_high};
}

Estimate estimate_mean(std::span<const double> values) {
    EXPECT(!values.empty());
    const double mean = mean_of(values);
    if (values.size() < 2) {
        return {mean, kNan, kNan, kNan};
    }
    double squares = 0;
    for (const double x : values) {
        squares += (x - mean) * (x - mean);
    }
    const auto n = static_cast<double>(values.size());
    return with_interval(mean, std::sqrt(squares / (n - 1) / n), values.size());
}

Estimate estimate_ratio(std::span<const double> a, std::span<const double> b) {
    EXPECT(a.size() == b.size() && !a.empty());
    const double mean_b = mean_of(b);
    if (mean_b == 0) {
        return {kNan, kNan, kNan, kNan};
    }
    const double ratio = mean_of(a) / mean_b;
    if (a.size() < 2) {
        return {ratio, kNan, kNan, kNan};
    }
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double residual = a[i] - ratio * b[i];
        squares += residual * residual;
    }
    const auto n = static_cast<double>(a.size());
    return with_interval(ratio, std::sqrt(squares / (n - 1) / n) / std::abs(mean_b), a.size());
}

Estimate estimate_unseen(double events, double most) {
    return {0, kNan, 0, 3 * most / events};
}

}  // namespace quasimc

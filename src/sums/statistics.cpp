#include "sums/statistics.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/checks.h"

namespace quasimc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// P(|T| < t) for integer degrees of freedom (Abramowitz and Stegun 26.7.3, 26.7.4).
double student_t_inside(double t, unsigned df) {
    const double theta = std::atan(t / std::sqrt(df));
    const double c2 = std::cos(theta) * std::cos(theta);
    const bool odd = df % 2 == 1;
    double term = odd ? std::cos(theta) : 1;
    double sum = df == 1 ? 0 : term;
    for (unsigned k = odd ? 3 : 2; k + 2 <= df; k += 2) {
        term *= c2 * (k - 1) / k;
        sum += term;
    }
    const double with_sine = std::sin(theta) * sum;
    return odd ? 2 / std::numbers::pi * (theta + with_sine) : with_sine;
}

/// For many degrees of freedom (Abramowitz and Stegun 26.7.5), z the normal quantile.
double large_df_quantile(double z, double df) {
    const double z3 = z * z * z;
    const double z5 = z3 * z * z;
    return z + (z3 + z) / (4 * df) + (5 * z5 + 16 * z3 + 3 * z) / (96 * df * df);
}

double bisect_quantile(double inside, unsigned df) {
    double low = 0;
    double high = 1;
    while (student_t_inside(high, df) < inside && high < 1e12) {
        high *= 2;
    }
    for (int i = 0; i < 200 && low < high; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) {
            break;
        }
        (student_t_inside(middle, df) < inside ? low : high) = middle;
    }
    return high;
}

double normal_quantile(double p) {
    double low = 0;
    double high = 40;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (0.5 * std::erfc(-middle / std::numbers::sqrt2) < p ? low : high) = middle;
    }
    return high;
}

/// The logarithm of the gamma function, x > 0: Stirling's series (Abramowitz and Stegun 6.1.41),
/// to 15 digits. (That of the standard library writes to a global variable.)
double log_gamma(double x) {
    double shift = 0;
    while (x < 20) {
        shift += std::log(x);
        x += 1;
    }
    const double y = 1 / (x * x);
    const double series = (1.0 / 12 - y * (1.0 / 360 - y * (1.0 / 1260 - y / 1680))) / x;
    return (x - 0.5) * std::log(x) - x + 0.5 * std::log(2 * std::numbers::pi) + series - shift;
}

/// The continued fraction of the incomplete beta function (DLMF 8.17.22), by the method of Lentz
/// (1976). Converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double x, double a, double b) {
    constexpr int kMostTerms = 100000;
    constexpr double kTiny = 1e-300;
    double value = 1;
    double c = 1;
    double d = 0;
    for (int j = 1; j < kMostTerms; ++j) {
        const bool is_odd = j % 2 == 1;
        const double m = (is_odd ? j - 1 : j) / 2.0;
        const double term = is_odd ? -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + j))
                                   : m * (b - m) * x / ((a + j - 1) * (a + j));
        d = 1 + term * d;
        d = 1 / (std::abs(d) < kTiny ? kTiny : d);
        c = 1 + term / c;
        c = std::abs(c) < kTiny ? kTiny : c;
        value *= c * d;
        if (std::abs(c * d - 1) < 1e-15) {
            break;
        }
    }
    return 1 / value;
}

/// The regularized incomplete beta function I_x(a, b), y = 1 - x.
double incomplete_beta(double x, double y, double a, double b) {
    if (x <= 0 || y <= 0) {
        return x <= 0 ? 0 : 1;
    }
    const double front = std::exp(
        log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * std::log(x) + b * std::log(y));
    return x < (a + 1) / (a + b + 2) ? front * beta_fraction(x, a, b) / a
                                     : 1 - front * beta_fraction(y, b, a) / b;
}

Estimate with_interval(double mean, double standard_error, std::size_t replicates) {
    const double half = interval_quantile(static_cast<unsigned>(replicates - 1)) * standard_error;
    return {mean, standard_error, mean - half, mean + half};
}

double mean_of(std::span<const double> values) {
    double sum = 0;
    for (const double x : values) {
        sum += x;
    }
    return sum / static_cast<double>(values.size());
}

}  // namespace

double student_t_quantile(double p, unsigned df) {
    EXPECT(p > 0 && p < 1 && df >= 1);
    if (p < 0.5) {
        return -student_t_quantile(1 - p, df);
    }
    constexpr unsigned kManyDegrees = 1000;
    return df > kManyDegrees ? large_df_quantile(normal_quantile(p), df)
                             : bisect_quantile(2 * p - 1, df);
}

double f_tail(double f, double above, double below) {
    EXPECT(f >= 0 && above > 0 && below > 0);
    const double sum = below + above * f;
    return incomplete_beta(below / sum, above * f / sum, below / 2, above / 2);
}

double interval_quantile(unsigned df) {
    // From a table, for there are millions of estimates.
    static const auto table = [] {
        std::array<double, 64> quantiles{};
        for (unsigned i = 1; i < quantiles.size(); ++i) {
            quantiles[i] = student_t_quantile(0.975, i);
        }
        return quantiles;
    }();
    return df < table.size() ? table[df] : student_t_quantile(0.975, df);
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

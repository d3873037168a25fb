#include <algorithm>
#include <cmath>

#include "base/checks.h"
#include "quasimc/result.h"
#include "scene/scene.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

/// Triangles are traced in single precision, and start areas are larger than the scene by 2^-20:
/// smaller differences count as a standard deviation of this size.
constexpr double kRounding = 1e-6;

/// Variance of the mean of an estimate; 0 where no light was sampled.
double variance(const Estimate& e) {
    const double error = std::isfinite(e.standard_error) ? e.standard_error : 0;
    return error * error + kRounding * kRounding * e.mean * e.mean;
}

/// Degrees of freedom of a sum of variances of means of `replicates` values each (Satterthwaite
/// 1946).
class Freedom {
  public:
    void add(double variance, std::uint32_t replicates) {
        sum_ += variance;
        spread_ += variance * variance / (replicates - 1.0);
    }
    [[nodiscard]] double degrees() const { return spread_ > 0 ? sum_ * sum_ / spread_ : 1; }

  private:
    double sum_ = 0, spread_ = 0;
};

/// Sum of squared differences over the sides of the organs.
class Scatter {
  public:
    Scatter(const Result& a, const Result& b) : a_(a), b_(b) {}

    void add(const Estimate& x, const Estimate& y, double weight) {
        if (!std::isfinite(x.mean) || !std::isfinite(y.mean)) {
            return;  // not measured
        }
        const double own = weight * (variance(x) + variance(y));
        squares_ += weight * (x.mean - y.mean) * (x.mean - y.mean);
        variances_ += own;
        spread_ += own * own;
        error_.add(weight * variance(x), a_.replicates);
        error_.add(weight * variance(y), b_.replicates);
    }

    /// A sum of squares of normal numbers over an estimate of its mean: F, with the degrees of
    /// freedom of a sum of unequal variances.
    void send(BandAudit& audit) const {
        if (!(variances_ > 0)) {
            return;
        }
        audit.reduced_chi_square = squares_ / variances_;
        audit.freedom = variances_ * variances_ / spread_;
        audit.chi_square_p_value =
            f_tail(audit.reduced_chi_square, audit.freedom, error_.degrees());
    }

  private:
    const Result& a_;
    const Result& b_;
    double squares_ = 0, variances_ = 0, spread_ = 0;
    Freedom error_;
};

void compare_totals(const Result& a, const Result& b, std::size_t band, BandAudit& audit) {
    const Estimate& x = a.budget[band].absorbed_by_organs;
    const Estimate& y = b.budget[band].absorbed_by_organs;
    const double sum = variance(x) + variance(y);
    audit.difference = x.mean - y.mean;
    audit.standard_error = std::isfinite(audit.difference) ? std::sqrt(sum) : audit.difference;
    if (std::isfinite(audit.difference) && sum > 0) {
        Freedom freedom;
        freedom.add(variance(x), a.replicates);
        freedom.add(variance(y), b.replicates);
        audit.difference_p_value =
            f_tail(audit.difference * audit.difference / sum, 1, freedom.degrees());
    }
}

}  // namespace

Audit compare_results(const Scene& scene, const Result& a, const Result& b) {
    EXPECT(a.bands == b.bands && a.organs() == b.organs() && a.replicates > 1 && b.replicates > 1);
    Audit audit{b.paths, b.replicates, std::vector<BandAudit>(a.bands)};
    double least = 1;
    for (std::size_t band = 0; band < a.bands; ++band) {
        Scatter scatter(a, b);
        for (std::size_t i = 0; i < a.organs(); ++i) {
            for (const Quantity side : {Quantity::incident_upper, Quantity::incident_lower}) {
                scatter.add(a.at(i, side, band), b.at(i, side, band), scene.organs()[i].area);
            }
        }
        BandAudit& own = audit.bands[band];
        scatter.send(own);
        compare_totals(a, b, band, own);
        least = std::min({least, own.chi_square_p_value, own.difference_p_value});
    }
    audit.p_value = std::min(1.0, least * 2 * static_cast<double>(a.bands));
    return audit;
}

}  // namespace quasimc

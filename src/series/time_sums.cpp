#include "series/time_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sums/statistics.h"

namespace quasimc {

void TimeSum::add(const Estimate& estimate, double weight, double freedom) {
    mean_ += weight * estimate.mean;
    if (std::isfinite(estimate.standard_error)) {
        const double error = weight * estimate.standard_error;
        variance_ += error * error;
        spread_ += error * error * error * error / freedom;
    } else if (std::isfinite(estimate.ci95_high)) {
        unseen_ += weight * estimate.ci95_high;
    } else {
        is_unknown_ = true;
    }
}

Estimate TimeSum::estimate() const {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    if (is_unknown_) {
        return {mean_, kNan, kNan, kNan};
    }
    if (variance_ == 0) {
        // Exactly known, or without contributions.
        const double error = unseen_ > 0 ? kNan : 0;
        return {mean_, error, mean_, mean_ + unseen_};
    }
    constexpr double kMaxFreedom = 1e6;
    const double freedom = std::clamp(variance_ * variance_ / spread_, 1.0, kMaxFreedom);
    const double error = std::sqrt(variance_);
    const double half = interval_quantile(static_cast<unsigned>(freedom)) * error;
    return not_negative({mean_, error, mean_ - half, mean_ + half + unseen_});
}

void TimeQuotient::add(
    const Estimate& share, const Estimate& whole, const TimeWeight& weight, double freedom) {
    if (whole.mean == 0) {
        return;
    }
    const double of_part = weight.part * whole.mean;
    part_ += of_part * share.mean;
    whole_ += weight.whole * whole.mean;
    if (std::isfinite(share.standard_error)) {
        const double error = of_part * share.standard_error;
        const double of_whole = std::isfinite(whole.standard_error) ? whole.standard_error : 0;
        const double part = weight.part * share.mean;
        variance_ += error * error;
        spread_ += error * error * error * error / freedom;
        of_whole_[0] += weight.whole * of_whole * weight.whole * of_whole;
        of_whole_[1] += weight.whole * of_whole * part * of_whole;
        of_whole_[2] += part * of_whole * part * of_whole;
    } else if (std::isfinite(share.ci95_high)) {
        unseen_ += of_part * share.ci95_high;
    } else {
        is_unknown_ = true;
    }
}

Estimate TimeQuotient::estimate() const {
    if (is_unknown_ || !(whole_ > 0)) {
        return kUnknownEstimate;
    }
    const double share = part_ / whole_;
    const auto& [zero, one, two] = of_whole_;
    const double differing = std::max(0.0, two - 2 * share * one + share * share * zero);
    TimeSum sum;
    sum.mean_ = share;
    sum.variance_ = (variance_ + differing) / (whole_ * whole_);
    sum.spread_ = spread_ / (whole_ * whole_ * whole_ * whole_);
    sum.unseen_ = unseen_ / whole_;
    return sum.estimate();
}

}  // namespace quasimc

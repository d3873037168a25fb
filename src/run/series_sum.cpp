#include "run/series_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sums/statistics.h"

namespace quasimc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void SeriesAdder::add(const Result& result, double weight) {
    cells_.resize(result.values.size());
    const double freedom = std::max(1.0, static_cast<double>(result.replicates) - 1);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const Estimate& estimate = result.values[i];
        Cell& cell = cells_[i];
        cell.mean += weight * estimate.mean;
        if (std::isfinite(estimate.standard_error)) {
            const double error = weight * estimate.standard_error;
            cell.variance += error * error;
            cell.spread += error * error * error * error / freedom;
        } else if (std::isfinite(estimate.high)) {
            cell.unseen += weight * estimate.high;
        } else {
            cell.is_unknown = true;
        }
    }
}

SeriesSum SeriesAdder::sum(std::size_t bands, std::size_t values) const {
    SeriesSum sum{bands, seconds_, std::vector<Estimate>(values)};
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const Cell& cell = cells_[i];
        if (cell.is_unknown) {
            sum.values[i] = {cell.mean, kNan, kNan, kNan};
            continue;
        }
        if (cell.variance == 0) {
            // Known exactly, or never seen.
            const double error = cell.unseen > 0 ? kNan : 0;
            sum.values[i] = {cell.mean, error, cell.mean, cell.mean + cell.unseen};
            continue;
        }
        constexpr double kMostFreedom = 1e6;
        const double freedom =
            std::clamp(cell.variance * cell.variance / cell.spread, 1.0, kMostFreedom);
        const double error = std::sqrt(cell.variance);
        const double half = interval_quantile(static_cast<unsigned>(freedom)) * error;
        sum.values[i] = {cell.mean, error, cell.mean - half, cell.mean + half + cell.unseen};
    }
    return sum;
}

}  // namespace quasimc

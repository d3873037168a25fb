#include "series/series_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sums/statistics.h"

namespace quasimc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void SeriesAdder::add_all(
    const std::vector<Estimate>& values, double weight, double freedom, Cells& cells) {
    cells.resize(values.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Estimate& estimate = values[i];
        Cell& cell = cells[i];
        cell.mean += weight * estimate.mean;
        if (std::isfinite(estimate.standard_error)) {
            const double error = weight * estimate.standard_error;
            cell.variance += error * error;
            cell.spread += error * error * error * error / freedom;
        } else if (std::isfinite(estimate.ci95_high)) {
            cell.unseen += weight * estimate.ci95_high;
        } else {
            cell.is_unknown = true;
        }
    }
}

void SeriesAdder::add(const Result& result, double weight) {
    const double freedom = std::max(1.0, static_cast<double>(result.replicates) - 1);
    add_all(result.values, weight, freedom, cells_);
    add_all(result.groups.values, weight, freedom, group_cells_);
}

Estimate SeriesAdder::estimate_of(const Cell& cell) {
    if (cell.is_unknown) {
        return {cell.mean, kNan, kNan, kNan};
    }
    if (cell.variance == 0) {
        // Exactly known, or without contributions.
        const double error = cell.unseen > 0 ? kNan : 0;
        return {cell.mean, error, cell.mean, cell.mean + cell.unseen};
    }
    constexpr double kMaxFreedom = 1e6;
    const double freedom =
        std::clamp(cell.variance * cell.variance / cell.spread, 1.0, kMaxFreedom);
    const double error = std::sqrt(cell.variance);
    const double half = interval_quantile(static_cast<unsigned>(freedom)) * error;
    return not_negative({cell.mean, error, cell.mean - half, cell.mean + half + cell.unseen});
}

SeriesSum SeriesAdder::sum(
    std::size_t bands, std::size_t values, const GroupResults& groups) const {
    SeriesSum sum{bands, seconds_, std::vector<Estimate>(values), groups};
    std::transform(cells_.begin(), cells_.end(), sum.values.begin(), estimate_of);
    if (!groups.values.empty()) {
        std::transform(
            group_cells_.begin(), group_cells_.end(), sum.groups.values.begin(), estimate_of);
    }
    return sum;
}

}  // namespace quasimc

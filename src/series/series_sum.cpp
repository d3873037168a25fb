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

void SeriesAdder::add_part(const Result& result, const Result* sensors, double weight, Part& part) {
    const double freedom = std::max(1.0, static_cast<double>(result.replicates) - 1);
    add_all(result.values, weight, freedom, part.organs);
    add_all(result.groups.values, weight, freedom, part.groups);
    if (sensors != nullptr) {
        add_all(sensors->values, weight, freedom, part.sensors);
    }
}

void SeriesAdder::add(const Result& result, double weight) {
    const Result* sensors = result.sensors.get();
    add_part(result, sensors, weight, all_);
    add_shares(result, weight, std::max(1.0, static_cast<double>(result.replicates) - 1));
    for (std::size_t i = 0; i < result.origins.size(); ++i) {
        add_part(
            result.origins[i].light, sensors != nullptr ? &sensors->origins[i].light : nullptr,
            weight, origins_[i]);
    }
}

void SeriesAdder::add_shares(const Result& result, double weight, double freedom) {
    const GroupResults& groups = result.groups;
    shares_.resize(groups.shares.size());
    for (std::size_t i = 0; i < shares_.size(); ++i) {
        const std::size_t band = i % groups.bands;
        const bool is_of_incident =
            i / groups.bands % kGroupShares == static_cast<std::size_t>(GroupShare::incident);
        const Estimate absorbed = groups.at(0, Quantity::absorbed_flux, band);
        const double whole = !is_of_incident         ? absorbed.mean
                             : result.canopy.empty() ? kNan
                                                     : result.canopy[band].incident;
        if (whole == 0) {
            continue;
        }
        const Estimate& share = groups.shares[i];
        Quotient& sum = shares_[i];
        sum.part += weight * whole * share.mean;
        sum.whole += weight * whole;
        if (std::isfinite(share.standard_error)) {
            const double error = weight * whole * share.standard_error;
            const double of_whole = is_of_incident ? 0 : weight * absorbed.standard_error;
            sum.variance += error * error;
            sum.spread += error * error * error * error / freedom;
            for (std::size_t k = 0; k < sum.of_whole.size(); ++k) {
                sum.of_whole[k] += of_whole * of_whole * std::pow(share.mean, k);
            }
        } else if (std::isfinite(share.ci95_high)) {
            sum.unseen += weight * whole * share.ci95_high;
        } else {
            sum.is_unknown = true;
        }
    }
}

Estimate SeriesAdder::estimate_of_quotient(const Quotient& quotient) {
    const double whole = quotient.whole;
    if (quotient.is_unknown || !(whole > 0)) {
        return kUnknownEstimate;
    }
    const double share = quotient.part / whole;
    const auto& [zero, one, two] = quotient.of_whole;
    const double differing = std::max(0.0, two - 2 * share * one + share * share * zero);
    return estimate_of(
        {.mean = share,
         .variance = (quotient.variance + differing) / (whole * whole),
         .spread = quotient.spread / (whole * whole * whole * whole),
         .unseen = quotient.unseen / whole});
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

/// @param count  of estimates, which are 0 where nothing was added
std::vector<Estimate> SeriesAdder::estimates_of(const Cells& cells, std::size_t count) {
    std::vector<Estimate> estimates(count);
    for (std::size_t i = 0; i < std::min(count, cells.size()); ++i) {
        estimates[i] = estimate_of(cells[i]);
    }
    return estimates;
}

SeriesSum SeriesAdder::sum(
    std::size_t bands,
    std::size_t values,
    const GroupResults& groups,
    std::size_t of_sensors) const {
    const auto sum_of = [&](const Part& part) {
        SeriesSum sum{bands, seconds_, estimates_of(part.organs, values), groups, {}};
        sum.groups.values = estimates_of(part.groups, groups.values.size());
        return sum;
    };
    const auto sensors_of = [&](const Part& part) {
        return SeriesSum{bands, seconds_, estimates_of(part.sensors, of_sensors), {}, {}};
    };
    SeriesSum sum = sum_of(all_);
    if (!groups.values.empty()) {
        sum.groups.shares.assign(groups.groups.size() * kGroupShares * bands, kUnknownEstimate);
        std::transform(
            shares_.begin(), shares_.end(), sum.groups.shares.begin(), estimate_of_quotient);
    }
    SeriesSum sensors = sensors_of(all_);
    for (const Part& part : origins_) {
        sum.origins.push_back({part.name, sum_of(part)});
        sensors.origins.push_back({part.name, sensors_of(part)});
    }
    if (of_sensors > 0) {
        sum.sensors = std::make_shared<const SeriesSum>(std::move(sensors));
    }
    return sum;
}

}  // namespace quasimc

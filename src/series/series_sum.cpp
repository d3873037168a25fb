#include "series/series_sum.h"

#include <algorithm>
#include <limits>

namespace quasimc {
namespace {

void add_all(
    const std::vector<Estimate>& values,
    double weight,
    double freedom,
    std::vector<TimeSum>& sums) {
    sums.resize(values.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i].add(values[i], weight, freedom);
    }
}

/// @param count  of estimates, which are 0 where nothing was added
std::vector<Estimate> estimates_of(const std::vector<TimeSum>& sums, std::size_t count) {
    std::vector<Estimate> estimates(count);
    for (std::size_t i = 0; i < std::min(count, sums.size()); ++i) {
        estimates[i] = sums[i].estimate();
    }
    return estimates;
}

double freedom_of(const Result& result) {
    return std::max(1.0, static_cast<double>(result.replicates) - 1);
}

}  // namespace

void SeriesAdder::add_part(const Result& result, const Result* sensors, double weight, Part& part) {
    add_all(result.values, weight, freedom_of(result), part.organs);
    add_all(result.groups.values, weight, freedom_of(result), part.groups);
    if (sensors != nullptr) {
        add_all(sensors->values, weight, freedom_of(result), part.sensors);
    }
}

void SeriesAdder::add(const Result& result, double weight, double seconds) {
    const Result* sensors = result.sensors.get();
    lacks_sensors_ = lacks_sensors_ || sensors == nullptr;
    add_part(result, sensors, weight, all_);
    add_shares(result, weight, freedom_of(result));
    add_canopy(result, weight, freedom_of(result));
    for (std::size_t i = 0; i < result.origins.size(); ++i) {
        add_part(
            result.origins[i].light, sensors != nullptr ? &sensors->origins[i].light : nullptr,
            weight, origins_[i]);
    }
    if (has_parts_) {
        const TimeWeight times{weight, seconds};
        organ_parts_.add(result.sun_shade, result.sunlit_fraction, times, freedom_of(result));
        group_parts_.add(
            result.groups.sun_shade, result.groups.sunlit_fraction, times, freedom_of(result));
        if (sensors != nullptr) {
            sensor_hours_.add({}, sensors->sunlit_fraction, times, freedom_of(result));
        }
    }
}

void SeriesAdder::add_shares(const Result& result, double weight, double freedom) {
    const GroupResults& groups = result.groups;
    shares_.resize(groups.shares.size());
    for (std::size_t i = 0; i < shares_.size(); ++i) {
        const std::size_t band = i % groups.bands;
        const bool is_of_incident =
            i / groups.bands % kGroupShares == static_cast<std::size_t>(GroupShare::incident);
        constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
        const double incident = result.canopy.empty() ? kNan : result.canopy[band].incident;
        const Estimate whole =
            is_of_incident ? Estimate{incident} : groups.at(0, Quantity::absorbed_flux, band);
        shares_[i].add(groups.shares[i], whole, {weight, weight}, freedom);
    }
}

void SeriesAdder::add_canopy(const Result& result, double weight, double freedom) {
    canopy_.resize(result.canopy.size());
    for (std::size_t b = 0; b < canopy_.size(); ++b) {
        const CanopyFractions& own = result.canopy[b];
        canopy_[b].incident += weight * own.incident;
        for (std::size_t i = 0; i < fraction_table().size(); ++i) {
            canopy_[b].fractions[i].add(
                own.*fraction_table()[i].part, {own.incident}, {weight, weight}, freedom);
        }
    }
}

std::vector<CanopyFractions> SeriesAdder::canopy() const {
    std::vector<CanopyFractions> all;
    for (const CanopyOfBand& sums : canopy_) {
        CanopyFractions& own = all.emplace_back();
        own.incident = sums.incident;
        for (std::size_t i = 0; i < fraction_table().size(); ++i) {
            own.*fraction_table()[i].part = sums.fractions[i].estimate();
        }
    }
    return all;
}

/// Sets the light of parts, and sunlit hours.
void SeriesAdder::put_parts(SeriesSum& sum) const {
    sum.sun_shade = organ_parts_.sum(seconds_);
    sum.sunlit_hours = organ_parts_.sunlit_hours();
    sum.groups.sun_shade = group_parts_.sum(seconds_);
    sum.groups.sunlit_fraction = group_parts_.sunlit_hours();
    for (std::size_t i = 0; i < sum.groups.groups.size(); ++i) {
        sum.groups.sunlit_area.push_back(
            scaled(sum.groups.sunlit_fraction[i], sum.groups.groups[i].area));
    }
}

SeriesSum SeriesAdder::sum(
    std::size_t bands,
    std::size_t values,
    const GroupResults& groups,
    std::size_t of_sensors) const {
    const auto sum_of = [&](const Part& part) {
        SeriesSum sum;
        sum.bands = bands;
        sum.seconds = seconds_;
        sum.values = estimates_of(part.organs, values);
        sum.groups = groups;
        sum.groups.values = estimates_of(part.groups, groups.values.size());
        return sum;
    };
    const auto sensors_of = [&](const Part& part) {
        SeriesSum sum;
        sum.bands = bands;
        sum.seconds = seconds_;
        sum.values = estimates_of(part.sensors, of_sensors);
        return sum;
    };
    SeriesSum sum = sum_of(all_);
    sum.canopy = canopy();
    if (!groups.values.empty()) {
        sum.groups.shares.assign(groups.groups.size() * kGroupShares * bands, kUnknownEstimate);
        std::ranges::transform(shares_, sum.groups.shares.begin(), [](const TimeQuotient& share) {
            return share.estimate();
        });
    }
    SeriesSum sensors = sensors_of(all_);
    if (has_parts_) {
        put_parts(sum);
        sensors.sunlit_hours = sensor_hours_.sunlit_hours();
    }
    for (const Part& part : origins_) {
        sum.origins.push_back({part.name, sum_of(part)});
        sensors.origins.push_back({part.name, sensors_of(part)});
    }
    if (of_sensors > 0 && !lacks_sensors_) {
        sum.sensors = std::make_shared<const SeriesSum>(std::move(sensors));
    }
    return sum;
}

}  // namespace quasimc

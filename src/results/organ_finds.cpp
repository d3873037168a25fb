#include "results/organ_finds.h"

#include <algorithm>
#include <cmath>

namespace quasimc {
namespace {

/// Either may happen.
SingleFind both(const SingleFind& a, const SingleFind& b) {
    return {std::hypot(a.more, b.more), std::hypot(a.less, b.less)};
}

SingleFind operator*(const SingleFind& find, double factor) {
    return {find.more * factor, find.less * factor};
}

/// Of light straight from the sources, of which a side got `found` and could have got `unoccluded`.
/// Where it could have got none from the points, light paths may have found it.
SingleFind direct_find(double found, double unoccluded, double tries, double by_light_path) {
    if (unoccluded == 0) {
        return {by_light_path, found == 0 ? 0 : by_light_path};
    }
    const double find = unoccluded / tries;
    return {found == unoccluded ? 0 : find, found == 0 ? 0 : find};
}

}  // namespace

OrganFinds::OrganFinds(const OrganReader& reader, std::size_t band)
    : knows_unoccluded_(reader.knows_unoccluded()),
      absorptance_(reader.largest_absorptance(band)),
      bound_(reader.flux_per_find(band)) {
    if (!knows_unoccluded_) {
        return;
    }
    Incident mean;
    // Light paths have many finds, and their replicates tell, where each replicate has some.
    std::uint32_t upper_seen = 0;
    std::uint32_t lower_seen = 0;
    std::uint32_t seen = 0;
    const auto count = static_cast<double>(reader.replicates());
    for (std::uint32_t r = 0; r < reader.replicates(); ++r) {
        const Incident in = reader.incident(r, band);
        upper_seen += in.scattered_upper > 0 ? 1 : 0;
        lower_seen += in.scattered_lower > 0 ? 1 : 0;
        seen += in.scattered_upper > 0 || in.scattered_lower > 0 ? 1 : 0;
        mean.direct_upper += in.direct_upper / count;
        mean.direct_lower += in.direct_lower / count;
        mean.scattered_upper += in.scattered_upper / count;
        mean.scattered_lower += in.scattered_lower / count;
        mean.unoccluded_upper += in.unoccluded_upper / count;
        mean.unoccluded_lower += in.unoccluded_lower / count;
    }
    const double tries = count * reader.samples();
    const double by_path = reader.flux_per_light_path(band) / count;
    const double upper_path = upper_seen < reader.replicates() ? by_path : 0;
    const double lower_path = lower_seen < reader.replicates() ? by_path : 0;
    // Where the points can't see a source, light paths may bring its light.
    const bool is_hidden = mean.unoccluded_upper == 0 && mean.unoccluded_lower == 0;
    const double direct_path = is_hidden ? by_path : 0;
    direct_.upper = direct_find(mean.direct_upper, mean.unoccluded_upper, tries, direct_path);
    direct_.lower = direct_find(mean.direct_lower, mean.unoccluded_lower, tries, direct_path);
    const double scattered = reader.scattered_flux_per_find(band) / count;
    const double upper = std::hypot(scattered, upper_path);
    const double lower = std::hypot(scattered, lower_path);
    scattered_.upper = {upper, mean.scattered_upper == 0 ? 0 : upper};
    scattered_.lower = {lower, mean.scattered_lower == 0 ? 0 : lower};
    // A sample looks for scattered light on one of the two sides.
    const double either = std::hypot(scattered, seen < reader.replicates() ? by_path : 0);
    on_either_ = {either, seen == 0 ? 0 : either};
}

SingleFind OrganFinds::find(Quantity quantity) const {
    const auto on_both_sides = [](const Kind& kind) { return both(kind.upper, kind.lower); };
    switch (quantity) {
        case Quantity::incident_upper:
            return both(direct_.upper, scattered_.upper);
        case Quantity::incident_lower:
            return both(direct_.lower, scattered_.lower);
        case Quantity::incident_direct:
            return on_both_sides(direct_);
        case Quantity::incident_scattered:
            return on_either_;
        default:
            return both(on_both_sides(direct_), on_either_) * absorptance_;
    }
}

Estimate OrganFinds::estimate(
    const QuantityEntry& entry, double per_area, std::span<const double> values) const {
    const double unit = entry.is_flux ? 1 : per_area;
    if (knows_unoccluded_) {
        const SingleFind one = find(entry.quantity);
        return estimate_finds(values, {one.more * unit, one.less * unit});
    }
    const bool is_absorbed = entry.quantity == Quantity::absorbed_flux ||
                             entry.quantity == Quantity::absorbed_flux_density;
    return estimate_seen_or_bound(values, bound_ * unit * (is_absorbed ? absorptance_ : 1));
}

}  // namespace quasimc

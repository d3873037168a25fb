#include "results/bounds/organ_contributions.h"

#include <algorithm>
#include <cmath>

namespace quasimc {
namespace {

/// Size of a contribution where either of two may be missing.
ContributionSize both(const ContributionSize& a, const ContributionSize& b) {
    // Usually one of the two is zero.
    const auto sum = [](double x, double y) { return x == 0 ? y : y == 0 ? x : std::hypot(x, y); };
    return {sum(a.more, b.more), sum(a.less, b.less)};
}

ContributionSize operator*(const ContributionSize& contribution, double factor) {
    return {contribution.more * factor, contribution.less * factor};
}

/// With this many contributions of scattered light per replicate, the spread of the replicates
/// suffices.
constexpr double kManyContributions = 5;

/// One contribution to light that consists of `contributions` of them in all replicates.
/// @param most  its largest possible size
ContributionSize contribution_among(
    double mean,
    double contributions,
    double most,
    double replicates,
    double many = kManyContributions) {
    if (mean == 0) {
        return {most, 0};
    }
    // Light of less than one quantum consists of an unknown number of contributions: one is
    // assumed.
    contributions = contributions > 0 ? contributions : 1;
    const double few = std::max(0.0, 1 - contributions / (many * replicates));
    const double mean_size = mean / contributions;
    return {few * std::max(mean_size, most / (contributions + 1)), few * mean_size};
}

/// One contribution to direct light on a side that got `found` and could have got `unoccluded`.
/// Sides whose points see no source may receive light by light paths.
ContributionSize direct_contribution(
    double found, double unoccluded, double tries, double by_light_path) {
    if (unoccluded == 0) {
        return {by_light_path, found == 0 ? 0 : by_light_path};
    }
    const double contribution = unoccluded / tries;
    return {found == unoccluded ? 0 : contribution, found == 0 ? 0 : contribution};
}

}  // namespace

OrganContributions::OrganContributions(const OrganReader& reader, std::size_t band)
    : knows_unoccluded_(reader.knows_unoccluded()),
      knows_kinds_(!knows_unoccluded_ && reader.strategies() > 0),
      absorptance_(reader.largest_absorptance(band)),
      bound_(reader.largest_direct(band)) {
    if (knows_unoccluded_) {
        set_unoccluded(reader, band);
    } else if (knows_kinds_) {
        set_kinds(reader, band);
    }
}

void OrganContributions::set_unoccluded(const OrganReader& reader, std::size_t band) {
    Incident mean;
    const auto count = static_cast<double>(reader.replicates());
    for (std::uint32_t r = 0; r < reader.replicates(); ++r) {
        const Incident in = reader.incident(r, band);
        mean.direct_upper += in.direct_upper / count;
        mean.direct_lower += in.direct_lower / count;
        mean.scattered_upper += in.scattered_upper / count;
        mean.scattered_lower += in.scattered_lower / count;
        mean.unoccluded_upper += in.unoccluded_upper / count;
        mean.unoccluded_lower += in.unoccluded_lower / count;
    }
    const double tries = count * reader.samples();
    const double by_path = reader.largest_by_light_path(band) / count;
    // Light paths may deliver light of sources that the points can't see.
    const bool is_hidden = mean.unoccluded_upper == 0 && mean.unoccluded_lower == 0;
    const double direct_path = is_hidden ? by_path : 0;
    direct_.upper =
        direct_contribution(mean.direct_upper, mean.unoccluded_upper, tries, direct_path);
    direct_.lower =
        direct_contribution(mean.direct_lower, mean.unoccluded_lower, tries, direct_path);
    if (!reader.is_flat()) {
        // The number of points on the triangle that the sun shines on most is equal in nearly all
        // replicates; few differ by one.
        const double one = bound_ / count;
        direct_.upper = larger(direct_.upper, {one, mean.direct_upper > 0 ? one : 0});
        direct_.lower = larger(direct_.lower, {one, mean.direct_lower > 0 ? one : 0});
    }
    // Contributions of points must not hide that light paths sampled nothing. A sample gathers
    // scattered light on one of the two sides.
    const double contribution =
        std::hypot(reader.part_in_view() * reader.largest_scattered(band) / count, by_path);
    const auto scattered = [&](double found) {
        return ContributionSize{contribution, found == 0 ? 0 : contribution};
    };
    scattered_ = {scattered(mean.scattered_upper), scattered(mean.scattered_lower)};
    on_either_ = scattered(mean.scattered_upper + mean.scattered_lower);
}

namespace {

/// Whether all replicates have equally many contributions. Paths of a point set are so evenly
/// distributed that with 4.96 expected nearly all replicates have 5; then their spread does not
/// show how often one has another number.
bool agrees_by_chance(const OrganReader& reader, std::size_t kind, SurfaceSide side) {
    return reader.strategy(kind).by == SampledBy::paths && reader.found_alike(kind, side);
}

/// Whether the first replicate alone has enough contributions for all of them; usually it has.
bool has_plenty(const OrganReader& reader, std::size_t kind, SurfaceSide side) {
    const OrganReader::Found first = reader.found(kind, side, 1);
    return first.units > 0 && first.contributions() >= 2 * reader.strategy(kind).many &&
           !agrees_by_chance(reader, kind, side);
}

/// At least one contribution of mean size.
ContributionSize at_least_one(
    const ContributionSize& contribution, double mean, double contributions) {
    const double mean_size = mean > 0 ? mean / contributions : 0;
    return larger(contribution, {mean_size, mean_size});
}

}  // namespace

void OrganContributions::set_kinds(const OrganReader& reader, std::size_t band) {
    const auto count = static_cast<double>(reader.replicates());
    for (std::size_t i = 0; i < reader.strategies(); ++i) {
        const SamplingStrategy& light = reader.strategy(i);
        const double flux = reader.flux_per_unit(i, band) / count;
        const bool is_path = light.by == SampledBy::paths;
        for (const SurfaceSide side : kSurfaceSides) {
            if (has_plenty(reader, i, side)) {
                continue;
            }
            const OrganReader::Found found = reader.found(i, side, reader.replicates());
            ContributionSize contribution = contribution_among(
                found.units * flux, found.contributions(),
                reader.units_per_contribution(i, side, found.units > 0) * flux, count, light.many);
            contribution.less = light.spectra.empty() ? contribution.more : contribution.less;
            if (agrees_by_chance(reader, i, side)) {
                contribution =
                    at_least_one(contribution, found.units * flux, found.contributions());
            }
            Kind& kind = is_path ? by_path_ : direct_;
            ContributionSize& sum = side == SurfaceSide::upper ? kind.upper : kind.lower;
            sum = is_path ? larger(sum, contribution) : both(sum, contribution);
        }
    }
    set_scattered(reader, band);
    const auto is_none = [](const ContributionSize& contribution) {
        return contribution.more == 0 && contribution.less == 0;
    };
    is_settled_ = is_none(on_either_);
    for (const Kind* kind : {&direct_, &by_path_, &scattered_}) {
        is_settled_ = is_settled_ && is_none(kind->upper) && is_none(kind->lower);
    }
}

void OrganContributions::set_scattered(const OrganReader& reader, std::size_t band) {
    const auto count = static_cast<double>(reader.replicates());
    const double once = reader.largest_scattered(band) / count;
    const double upper = reader.scattered(SurfaceSide::upper, band) / count;
    const double lower = reader.scattered(SurfaceSide::lower, band) / count;
    const auto by_contribution = [&](double mean, double contribution) {
        return contribution_among(mean, mean / contribution, contribution, count);
    };
    scattered_ = {by_contribution(upper, once), by_contribution(lower, once)};
    on_either_ = by_contribution(upper + lower, once);
    // A path inside a hollow organ hits it repeatedly, each time with the same probability: this is
    // the mean square of its contributions over their mean.
    const double again = reader.largest_albedo(band);
    const auto most = [&](double part) { return once * (1 + part) / (1 - part); };
    if (again >= 1 || std::min(upper, lower) > kManyContributions * count * most(again)) {
        return;
    }
    const auto [side, part] = reader.hollow();
    const bool is_upper = side == SurfaceSide::upper;
    const ContributionSize inside = by_contribution(is_upper ? upper : lower, most(again * part));
    (is_upper ? scattered_.upper : scattered_.lower) = inside;
    on_either_ = part > 0 ? larger(on_either_, inside) : on_either_;
}

ContributionSize OrganContributions::contribution(Quantity quantity) const {
    const Parts found = parts(quantity);
    return both(found.by_sky_sample, found.by_path);
}

ContributionSize OrganContributions::incident_contribution() const {
    if (!knows_contributions() || is_settled_) {
        return {};
    }
    const Parts found = parts(kIncidentLight);
    return both(found.by_sky_sample, found.by_path);
}

/// Direct light, whether it was sampled from the organ or by light paths, on the requested sides.
template <typename Together>
ContributionSize OrganContributions::on_sides(
    const Kind& kind, const LightParts& parts, Together together) {
    return parts.upper && parts.lower ? together(kind.upper, kind.lower)
                                      : (parts.upper ? kind.upper : kind.lower);
}

/// Each path is one contribution: one more may deliver direct or scattered light.
OrganContributions::Parts OrganContributions::parts(const LightParts& parts) const {
    const bool has_both_sides = parts.upper && parts.lower;
    const ContributionSize direct =
        parts.direct ? on_sides(direct_, parts, both) : ContributionSize{};
    const ContributionSize by_path =
        parts.direct ? on_sides(by_path_, parts, larger) : ContributionSize{};
    const ContributionSize scattered = !parts.scattered ? ContributionSize{}
                                       : has_both_sides ? on_either_
                                                        : on_sides(scattered_, parts, both);
    const Parts found = knows_unoccluded_ ? Parts{{}, both(direct, scattered)}
                                          : Parts{direct, larger(by_path, scattered)};
    return parts.is_absorbed
               ? Parts{found.by_sky_sample * absorptance_, found.by_path * absorptance_}
               : found;
}

namespace {

/// Mean sunlit area that one strategy may have contributed at most.
/// @param found  light of that strategy
/// @param most  area that one of its contributions lights
double sunlit_area_by(
    const OrganReader& reader, std::size_t kind, const OrganReader::Found& found, double most) {
    double area = 0;
    for (std::uint32_t r = 0; r < reader.replicates(); ++r) {
        area += reader.sunlit_area(r) / reader.replicates();
    }
    for (std::size_t other = 0; other < reader.strategies(); ++other) {
        if (other != kind && reader.strategy(other).has_suns) {
            return found.units > 0 ? std::min(area, found.contributions() * most) : 0;
        }
    }
    return area;
}

/// One contribution of a strategy to the sunlit area.
ContributionSize sunlit_contribution_of(const OrganReader& reader, std::size_t kind) {
    if (has_plenty(reader, kind, SurfaceSide::upper) ||
        has_plenty(reader, kind, SurfaceSide::lower)) {
        return {};
    }
    OrganReader::Found found = reader.found(kind, SurfaceSide::upper, reader.replicates());
    const OrganReader::Found lower = reader.found(kind, SurfaceSide::lower, reader.replicates());
    found = {found.units + lower.units, found.squares + lower.squares};
    const auto count = static_cast<double>(reader.replicates());
    const auto most = [&](bool is_seen) {
        return reader.sunlit_per_contribution(kind, is_seen) * reader.largest_sunlit() / count;
    };
    const bool is_known = !reader.strategy(kind).spectra.empty();
    const double area = is_known ? sunlit_area_by(reader, kind, found, most(true)) : 0;
    ContributionSize contribution = contribution_among(
        area, found.contributions(), most(area > 0), count, reader.strategy(kind).many);
    contribution.less = is_known ? contribution.less : contribution.more;
    return agrees_by_chance(reader, kind, SurfaceSide::upper) &&
                   agrees_by_chance(reader, kind, SurfaceSide::lower)
               ? at_least_one(contribution, area, found.contributions())
               : contribution;
}

}  // namespace

ContributionSize OrganContributions::sunlit_contribution(const OrganReader& reader) {
    ContributionSize sum;
    for (std::size_t i = 0; i < reader.strategies(); ++i) {
        if (reader.strategy(i).has_suns) {
            sum = both(sum, sunlit_contribution_of(reader, i));
        }
    }
    return sum;
}

Estimate OrganContributions::estimate(
    const QuantityEntry& entry, double per_area, std::span<const double> values) const {
    if (is_settled_) {
        return estimate_seen_or_bound(values, 0);
    }
    const double unit = entry.is_flux ? 1 : per_area;
    if (knows_contributions()) {
        const ContributionSize one = contribution(entry.quantity);
        return estimate_contributions(values, {one.more * unit, one.less * unit});
    }
    const double part = parts_of(entry.quantity).is_absorbed ? absorptance_ : 1;
    return estimate_seen_or_bound(values, bound_ * unit * part);
}

Estimate estimate_sunlit_points(std::span<const double> values, double all, double contribution) {
    const bool is_all = std::all_of(
        values.begin(), values.end(), [&](double lit) { return lit >= kFullyLit * all; });
    Estimate lit =
        estimate_contributions(values, {.more = is_all ? 0 : contribution, .less = contribution});
    lit.ci95_high = is_all ? std::max(lit.ci95_high, all) : lit.ci95_high;
    return lit;
}

namespace {

/// One contribution, scaled down with the number of contributions that the light consists of; with
/// many the spread of the replicates suffices. A ratio needs twice as many as an amount, for equal
/// contributions show nothing about missing ones.
ContributionSize contribution_among_few(
    double mean, const ContributionSize& contribution, double replicates) {
    const double most = std::max(contribution.more, contribution.less);
    const double many = 2 * kManyContributions * replicates;
    return most > 0 ? contribution * std::max(0.0, 1 - mean / (most * many)) : ContributionSize{};
}

ContributionSize contribution_to_ratio(const IncidentLight& above, const IncidentLight& below) {
    const double a = mean_of(above.per_replicate);
    const double b = mean_of(below.per_replicate);
    if (!(b > 0)) {
        return {};
    }
    const auto replicates = static_cast<double>(above.per_replicate.size());
    const ContributionSize of_a = contribution_among_few(a, above.contribution, replicates);
    const ContributionSize of_b = contribution_among_few(b, below.contribution, replicates);
    const double less = b - of_b.less;
    return {
        std::max(of_a.more / b, less > 0 ? a / less - a / b : 0),
        std::max(of_a.less / b, a / b - a / (b + of_b.more))};
}

}  // namespace

Estimate estimate_light_ratio(const IncidentLight& above, const IncidentLight& below) {
    return widened(
        not_negative(estimate_ratio(above.per_replicate, below.per_replicate)),
        contribution_to_ratio(above, below));
}

}  // namespace quasimc

#include "results/bounds/organ_contributions.h"

#include <algorithm>
#include <cmath>

namespace quasimc {
namespace {

/// Either may happen.
ContributionSize both(const ContributionSize& a, const ContributionSize& b) {
    // Mostly one of the two is none.
    const auto sum = [](double x, double y) { return x == 0 ? y : y == 0 ? x : std::hypot(x, y); };
    return {sum(a.more, b.more), sum(a.less, b.less)};
}

ContributionSize operator*(const ContributionSize& find, double factor) {
    return {find.more * factor, find.less * factor};
}

/// From so many finds of scattered light in each replicate on the replicates tell.
constexpr double kManyContributions = 5;

/// Of light that so many finds of all replicates brought. @param most  that a find may bring
ContributionSize find_among(
    double mean, double finds, double most, double replicates, double many = kManyContributions) {
    if (mean == 0) {
        return {most, 0};
    }
    // Of so little light that it is no step of a sum it is not known how many: one.
    finds = finds > 0 ? finds : 1;
    const double few = std::max(0.0, 1 - finds / (many * replicates));
    const double usual = mean / finds;
    return {few * std::max(usual, most / (finds + 1)), few * usual};
}

/// Of light straight from the sources, of which a side got `found` and could have got `unoccluded`.
/// Where it could have got none from the points, light paths may have found it.
ContributionSize direct_contribution(
    double found, double unoccluded, double tries, double by_light_path) {
    if (unoccluded == 0) {
        return {by_light_path, found == 0 ? 0 : by_light_path};
    }
    const double find = unoccluded / tries;
    return {found == unoccluded ? 0 : find, found == 0 ? 0 : find};
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
    // Where the points can't see a source, light paths may bring its light.
    const bool is_hidden = mean.unoccluded_upper == 0 && mean.unoccluded_lower == 0;
    const double direct_path = is_hidden ? by_path : 0;
    direct_.upper =
        direct_contribution(mean.direct_upper, mean.unoccluded_upper, tries, direct_path);
    direct_.lower =
        direct_contribution(mean.direct_lower, mean.unoccluded_lower, tries, direct_path);
    if (!reader.is_flat()) {
        // How many points lie on the triangle that the sun shines on most is the same in nearly all
        // replicates, one from what is expected in few.
        const double one = bound_ / count;
        direct_.upper = larger(direct_.upper, {one, mean.direct_upper > 0 ? one : 0});
        direct_.lower = larger(direct_.lower, {one, mean.direct_lower > 0 ? one : 0});
    }
    // What points have found must not hide that light paths have found nothing. A sample looks for
    // scattered light on one of the two sides.
    const double find =
        std::hypot(reader.part_in_view() * reader.largest_scattered(band) / count, by_path);
    const auto scattered = [&](double found) {
        return ContributionSize{find, found == 0 ? 0 : find};
    };
    scattered_ = {scattered(mean.scattered_upper), scattered(mean.scattered_lower)};
    on_either_ = scattered(mean.scattered_upper + mean.scattered_lower);
}

namespace {

/// Whether all replicates have as many finds as each other: paths of a point set are spread so
/// evenly that of 4.96 expected nearly all replicates find 5. They do not tell then how often one
/// has another number.
bool agrees_by_chance(const OrganReader& reader, std::size_t kind, SurfaceSide side) {
    return reader.strategy(kind).by == SampledBy::paths && reader.found_alike(kind, side);
}

/// Whether the first replicate alone has so many finds that all together have enough: most have.
bool has_plenty(const OrganReader& reader, std::size_t kind, SurfaceSide side) {
    const OrganReader::Found first = reader.found(kind, side, 1);
    return first.units > 0 && first.finds() >= 2 * reader.strategy(kind).many &&
           !agrees_by_chance(reader, kind, side);
}

/// At least a find more or less, of those that brought `mean`.
ContributionSize at_least_one(const ContributionSize& find, double mean, double finds) {
    const double usual = mean > 0 ? mean / finds : 0;
    return larger(find, {usual, usual});
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
            ContributionSize find = find_among(
                found.units * flux, found.finds(),
                reader.units_per_contribution(i, side, found.units > 0) * flux, count, light.many);
            find.less = light.spectra.empty() ? find.more : find.less;
            if (agrees_by_chance(reader, i, side)) {
                find = at_least_one(find, found.units * flux, found.finds());
            }
            Kind& kind = is_path ? by_path_ : direct_;
            ContributionSize& sum = side == SurfaceSide::upper ? kind.upper : kind.lower;
            sum = is_path ? larger(sum, find) : both(sum, find);
        }
    }
    set_scattered(reader, band);
    const auto is_none = [](const ContributionSize& find) {
        return find.more == 0 && find.less == 0;
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
    const auto by_contribution = [&](double mean, double find) {
        return find_among(mean, mean / find, find, count);
    };
    scattered_ = {by_contribution(upper, once), by_contribution(lower, once)};
    on_either_ = by_contribution(upper + lower, once);
    // A path that got into a hollow organ meets it again and again, each time by the same chance:
    // the mean square of what paths bring there over its mean.
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

ContributionSize OrganContributions::find(Quantity quantity) const {
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

/// Of the light that comes straight from the sources, or that paths of theirs bring, on the sides
/// of some parts.
template <typename Together>
ContributionSize OrganContributions::on_sides(
    const Kind& kind, const LightParts& parts, Together together) {
    return parts.upper && parts.lower ? together(kind.upper, kind.lower)
                                      : (parts.upper ? kind.upper : kind.lower);
}

/// Paths are finds whatever they bring: one more may bring direct light, or scattered.
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

/// Of the area that suns light in the mean, what one kind of them may have lit at most.
/// @param found  of that kind
/// @param most  area that one find of it lights
double sunlit_area_by(
    const OrganReader& reader, std::size_t kind, const OrganReader::Found& found, double most) {
    double area = 0;
    for (std::uint32_t r = 0; r < reader.replicates(); ++r) {
        area += reader.sunlit_area(r) / reader.replicates();
    }
    for (std::size_t other = 0; other < reader.strategies(); ++other) {
        if (other != kind && reader.strategy(other).has_suns) {
            return found.units > 0 ? std::min(area, found.finds() * most) : 0;
        }
    }
    return area;
}

/// Of the area that one kind of suns lights.
ContributionSize sunlit_find_of(const OrganReader& reader, std::size_t kind) {
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
    ContributionSize find =
        find_among(area, found.finds(), most(area > 0), count, reader.strategy(kind).many);
    find.less = is_known ? find.less : find.more;
    return agrees_by_chance(reader, kind, SurfaceSide::upper) &&
                   agrees_by_chance(reader, kind, SurfaceSide::lower)
               ? at_least_one(find, area, found.finds())
               : find;
}

}  // namespace

ContributionSize OrganContributions::sunlit_contribution(const OrganReader& reader) {
    ContributionSize sum;
    for (std::size_t i = 0; i < reader.strategies(); ++i) {
        if (reader.strategy(i).has_suns) {
            sum = both(sum, sunlit_find_of(reader, i));
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
        const ContributionSize one = find(entry.quantity);
        return estimate_contributions(values, {one.more * unit, one.less * unit});
    }
    const double part = parts_of(entry.quantity).is_absorbed ? absorptance_ : 1;
    return estimate_seen_or_bound(values, bound_ * unit * part);
}

Estimate estimate_sunlit_points(std::span<const double> values, double all, double find) {
    const bool is_all = std::all_of(
        values.begin(), values.end(), [&](double lit) { return lit >= kFullyLit * all; });
    Estimate lit = estimate_contributions(values, {.more = is_all ? 0 : find, .less = find});
    lit.ci95_high = is_all ? std::max(lit.ci95_high, all) : lit.ci95_high;
    return lit;
}

namespace {

/// A find, if what was found is so little that it may be a few of them; of many the replicates
/// tell. Of a ratio twice as many as of an amount: finds that are alike tell nothing of others.
ContributionSize find_among_few(double mean, const ContributionSize& find, double replicates) {
    const double most = std::max(find.more, find.less);
    const double many = 2 * kManyContributions * replicates;
    return most > 0 ? find * std::max(0.0, 1 - mean / (most * many)) : ContributionSize{};
}

ContributionSize find_of_ratio(const IncidentLight& above, const IncidentLight& below) {
    const double a = mean_of(above.per_replicate);
    const double b = mean_of(below.per_replicate);
    if (!(b > 0)) {
        return {};
    }
    const auto replicates = static_cast<double>(above.per_replicate.size());
    const ContributionSize of_a = find_among_few(a, above.find, replicates);
    const ContributionSize of_b = find_among_few(b, below.find, replicates);
    const double less = b - of_b.less;
    return {
        std::max(of_a.more / b, less > 0 ? a / less - a / b : 0),
        std::max(of_a.less / b, a / b - a / (b + of_b.more))};
}

}  // namespace

Estimate estimate_light_ratio(const IncidentLight& above, const IncidentLight& below) {
    return widened(
        not_negative(estimate_ratio(above.per_replicate, below.per_replicate)),
        find_of_ratio(above, below));
}

}  // namespace quasimc

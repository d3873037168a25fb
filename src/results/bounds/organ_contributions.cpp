#include "results/bounds/organ_contributions.h"

#include <algorithm>
#include <cmath>

namespace quasimc {
namespace {

/// With this many contributions of scattered light per replicate, the spread of the replicates
/// suffices.
constexpr double kManyContributions = 5;

/// The probability of another hit from which on light is trapped.
constexpr double kTrapped = 1 - 1e-6;

/// The light of one strategy, to which contributions of at most `largest` were made.
struct Counted {
    double number = 0;     ///< in all replicates
    double mean_size = 0;  ///< change of the mean by one
    double largest = 0;
    double many = 0;        ///< number from which on replicates suffice
    bool is_alike = false;  ///< whether their spread does not show the error
};

ContributionSize one_of(const Counted& light) {
    const double few = light.is_alike ? 1 : std::max(0.0, 1 - light.number / light.many);
    const double more = std::max(light.mean_size, light.largest / (light.number + 1));
    return light.number == 0 ? ContributionSize{light.largest, 0}
                             : ContributionSize{few * more, few * light.mean_size};
}

/// The counted light of a strategy. Paths of a point set are so evenly distributed that with 4.96
/// expected nearly all replicates have 5; then their spread does not show how often one has another
/// number.
Counted counted_by(const SamplingStrategy& strategy, const CountedLight& light, double replicates) {
    return {
        .number = light.number(),
        .many = strategy.many * replicates,
        .is_alike = strategy.by == SampledBy::paths && light.is_alike};
}

/// The contributions to both sides.
CountedLight together(const CountedLight& upper, const CountedLight& lower) {
    return {
        upper.units + lower.units, upper.squares + lower.squares, upper.is_alike && lower.is_alike};
}

/// The change by one contribution more or less. @param sample_of, size_of  of the index of a kind
template <typename SampleOf, typename SizeOf>
ContributionSize one_of_kinds(std::size_t kinds, const SampleOf& sample_of, const SizeOf& size_of) {
    ContributionSize path, rest;
    for (std::size_t i = 0; i < kinds; ++i) {
        const ContributionSize size = size_of(i);
        if (sample_of(i) == Sample::path) {
            path = larger(path, size);
        } else {
            rest = both(rest, size);
        }
    }
    return both(path, rest);
}

}  // namespace

ContributionSize one_contribution(std::span<const SampledContribution> kinds) {
    return one_of_kinds(
        kinds.size(), [&](std::size_t i) { return kinds[i].sample; },
        [&](std::size_t i) {
            return both(kinds[i].size, {kinds[i].unseen, 0});
        });
}

Estimate estimate_sunlit_fraction(
    std::span<const double> lit, ContributionSize one, bool has_points) {
    const bool is_all =
        has_points && std::ranges::all_of(lit, [](double each) { return each >= kFullyLit; });
    one.more = is_all ? 0 : one.more;
    Estimate fraction = estimate_contributions(lit, one);
    fraction.ci95_high = is_all ? std::max(fraction.ci95_high, 1.0) : fraction.ci95_high;
    return fraction;
}

OrganContributions::OrganContributions(
    const OrganReader& reader, std::size_t band, const Incident& light)
    : absorptance_(reader.largest_absorptance(band)), has_points_(reader.sums().has_points()) {
    if (has_points_) {
        read_points(reader, band, light);
    } else if (!reader.sums().data().strategies.empty()) {
        read_strategies(reader, band, light);
    } else {
        bound_ = reader.largest(reader.sums().direct, band) / reader.replicates();
    }
}

void OrganContributions::read_points(
    const OrganReader& reader, std::size_t band, const Incident& sum) {
    const double count = reader.replicates();
    const SumReader& sums = reader.sums();
    const double by_path = reader.largest(sums.light_path, band) / count;
    // Light paths may deliver light of sources that the points can't see.
    const bool is_hidden = sum.unoccluded_upper == 0 && sum.unoccluded_lower == 0;
    // The number of points on the triangle that the sun shines on most is equal in nearly all
    // replicates; few differ by one.
    const double on_triangle = reader.is_flat() ? 0 : reader.largest(sums.direct, band) / count;
    // Contributions of points must not hide that light paths sampled nothing.
    const double scattered =
        std::hypot(reader.part_in_view() * reader.largest_scattered(band) / count, by_path);
    for (const SurfaceSide side : kSurfaceSides) {
        const bool is_upper = side == SurfaceSide::upper;
        const double all = is_upper ? sum.unoccluded_upper : sum.unoccluded_lower;
        const double found = is_upper ? sum.direct_upper : sum.direct_lower;
        const double one =
            all > 0 ? all / (count * count * sums.samples) : (is_hidden ? by_path : 0);
        const double direct = std::max(one, on_triangle);
        kinds_.push_back(
            {side,
             true,
             false,
             sums.data().spectra.size() == 1,
             Sample::point,
             {all > 0 && found == all ? on_triangle : direct, found > 0 ? direct : 0}});
        const bool is_lit = (is_upper ? sum.scattered_upper : sum.scattered_lower) > 0;
        kinds_.push_back(
            {side, false, false, false, Sample::path, {scattered, is_lit ? scattered : 0}});
    }
}

void OrganContributions::read_strategies(
    const OrganReader& reader, std::size_t band, const Incident& sum) {
    const double count = reader.replicates();
    kinds_.reserve(2 * reader.sums().data().strategies.size() + 2);
    for (std::size_t i = 0; i < reader.sums().data().strategies.size(); ++i) {
        const SamplingStrategy& strategy = reader.sums().data().strategies[i];
        const bool is_path = strategy.by == SampledBy::paths;
        const double flux = reader.flux_per_unit(i, band) / count;
        for (const SurfaceSide side : kSurfaceSides) {
            const CountedLight found = reader.counted(i, side);
            Counted light = counted_by(strategy, found, count);
            light.mean_size = found.units > 0 ? found.units * flux / light.number : 0;
            light.largest = reader.units_per_contribution(i, side, found.units > 0) * flux;
            ContributionSize size = one_of(light);
            size.less = strategy.spectra.empty() ? size.more : size.less;
            const bool is_unseen = !is_path && size.less == 0;
            kinds_.push_back(
                {side, true, strategy.has_suns, strategy.spectra.size() == 1,
                 is_path ? Sample::path : Sample::ray, is_unseen ? ContributionSize{} : size,
                 is_unseen ? size.more : 0});
        }
    }
    const double once = reader.may_scatter(band) ? reader.largest_scattered(band) / count : 0;
    for (const SurfaceSide side : kSurfaceSides) {
        const double mean =
            (side == SurfaceSide::upper ? sum.scattered_upper : sum.scattered_lower) / count;
        // A path inside a hollow organ hits it repeatedly, each time with the same probability:
        // this is the mean square of its contributions over their mean.
        const double again =
            mean > 2 * kManyContributions * count * once
                ? 0
                : reader.largest_reflectance(band, side) * reader.self_view_factor(side, band);
        const double size = again < kTrapped ? once * (1 + again) / (1 - again) : once;
        kinds_.push_back(
            {side, false, false, false, Sample::path,
             one_of({size > 0 ? mean / size : 0, size, size, kManyContributions * count})});
    }
}

OrganContributions OrganContributions::sunlit(
    const OrganReader& reader, std::optional<SurfaceSide> side) {
    OrganContributions all;
    all.has_points_ = reader.sums().has_points();
    const auto& strategies = reader.sums().data().strategies;
    const double count = reader.replicates();
    const double one = reader.largest_sunlit() / count;
    if (all.has_points_) {
        all.kinds_ = {{.sample = Sample::point, .size = {one, one}}};
    }
    all.bound_ = !all.has_points_ && strategies.empty() ? one : 0;
    double area = 0;
    for (std::uint32_t r = 0; r < reader.replicates(); ++r) {
        area += reader.sunlit_area(r, side) / count;
    }
    for (std::size_t i = 0; !all.has_points_ && i < strategies.size(); ++i) {
        if (!strategies[i].has_suns) {
            continue;
        }
        const CountedLight found = side ? reader.counted(i, *side)
                                        : together(
                                              reader.counted(i, SurfaceSide::upper),
                                              reader.counted(i, SurfaceSide::lower));
        const bool is_known = !strategies[i].spectra.empty();
        Counted light = counted_by(strategies[i], found, count);
        light.largest = one * reader.sunlit_per_contribution(i, found.units > 0);
        // Light of other suns counts in the area too.
        light.mean_size =
            found.units > 0 ? std::min(area / light.number, light.largest) : light.largest;
        ContributionSize size = one_of(light);
        size.less = is_known ? size.less : size.more;
        const Sample sample = strategies[i].by == SampledBy::paths ? Sample::path : Sample::ray;
        all.kinds_.push_back({.sample = sample, .size = size});
    }
    return all;
}

void OrganContributions::include(const OrganContributions& organ, double weight) {
    kinds_.resize(organ.kinds_.size());
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
        const Kind& other = organ.kinds_[i];
        const Kind own = kinds_[i];
        const bool is_ray = other.sample == Sample::ray;
        kinds_[i] = other;
        const ContributionSize size = other.size * weight;
        kinds_[i].size = is_ray ? both(own.size, size) : larger(own.size, size);
        kinds_[i].unseen = own.unseen + other.unseen * weight;
    }
    absorptance_ = std::max(absorptance_, organ.absorptance_);
    bound_ = std::max(bound_, organ.bound_ * weight);
    has_points_ = organ.has_points_;
}

template <typename SizeOf>
ContributionSize OrganContributions::combined(const SizeOf& size_of) const {
    return one_of_kinds(
        kinds_.size(), [&](std::size_t i) { return kinds_[i].sample; },
        [&](std::size_t i) { return size_of(kinds_[i], i); });
}

bool OrganContributions::is_counted(const Kind& kind, const LightParts& parts) {
    return (kind.is_direct ? parts.direct : parts.scattered) && (parts.suns || !kind.has_suns) &&
           (kind.side == SurfaceSide::upper ? parts.upper : parts.lower);
}

std::vector<SampledContribution> OrganContributions::kinds(const LightParts& parts) const {
    std::vector<SampledContribution> counted;
    for (const Kind& kind : kinds_) {
        if (is_counted(kind, parts)) {
            counted.push_back({kind.sample, kind.size, kind.unseen});
        }
    }
    return counted;
}

ContributionSize OrganContributions::size(const LightParts& parts) const {
    const ContributionSize one = combined([&](const Kind& kind, std::size_t) {
        return is_counted(kind, parts) ? both(kind.size, {kind.unseen, 0}) : ContributionSize{};
    });
    return parts.is_absorbed ? one * absorptance_ : one;
}

ContributionSize OrganContributions::size(Quantity quantity, std::span<const double> values) const {
    return size(parts_of(quantity), values);
}

ContributionSize OrganContributions::size(
    const LightParts& parts, std::span<const double> values) const {
    if (bound_ == 0) {
        return size(parts);
    }
    const bool is_dark = std::ranges::all_of(values, [](double x) { return x == 0; });
    return {is_dark ? bound_ * (parts.is_absorbed ? absorptance_ : 1) : 0, 0};
}

Estimate OrganContributions::estimate(
    const QuantityEntry& entry, double per_area, std::span<const double> values) const {
    return estimate(parts_of(entry.quantity), entry.is_flux ? 1 : per_area, values);
}

Estimate OrganContributions::estimate(
    const LightParts& parts, double unit, std::span<const double> values) const {
    const double bound = bound_ * unit * (parts.is_absorbed ? absorptance_ : 1);
    return bound_ > 0 ? estimate_seen_or_bound(values, bound * static_cast<double>(values.size()))
                      : estimate_contributions(values, size(parts) * unit);
}

Estimate OrganContributions::estimate_sunlit(double area, std::span<const double> values) const {
    const double per_area = area > 0 ? 1 / area : 0;
    if (bound_ > 0) {
        const auto replicates = static_cast<double>(values.size());
        return estimate_seen_or_bound(values, bound_ * per_area * replicates);
    }
    return estimate_sunlit_fraction(values, size() * per_area, has_points_);
}

Estimate OrganContributions::estimate_ratio(
    const OrganContributions& above,
    const OrganContributions& below,
    std::span<const double> a,
    std::span<const double> b) {
    const Estimate ratio = not_negative(quasimc::estimate_ratio(a, b));
    const double light = mean_of(b);
    if (!(light > 0)) {
        return ratio;
    }
    return widened(ratio, above.combined([&](const Kind& kind, std::size_t i) {
        const Kind& other = below.kinds_[i];
        const ContributionSize one = both(kind.size, {kind.unseen, 0});
        const ContributionSize of_b = both(other.size, {other.unseen, 0}) * ratio.mean;
        if (!kind.has_one_spectrum) {  // a contribution may have light of one band alone
            return ContributionSize{std::max(one.more, of_b.less), std::max(one.less, of_b.more)} *
                   (1 / light);
        }
        const double more = one.more - of_b.more;
        const double less = of_b.less - one.less;
        return ContributionSize{std::max({more, less, 0.0}), std::max({-more, -less, 0.0})} *
               (1 / light);
    }));
}

}  // namespace quasimc

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

/// Contributions to one organ.
/// @param number  in all replicates
/// @param size  the change of the mean by one; with number 0 any
/// @param largest  the largest change
Contributions counted(double number, double size, double largest, bool varies) {
    return {
        .light = number * size,
        .root = std::sqrt(number) * size,
        .largest = number > 0 ? largest : 0,
        .unseen = number > 0 ? 0 : largest,
        .varies = varies ? 1.0 : 0.0};
}

/// The kind of the contributions of a strategy.
ContributionKind kind_of(const SamplingStrategy& strategy, double replicates) {
    return {
        strategy.by == SampledBy::paths ? Sample::path : Sample::ray,
        strategy.spectra.empty() ? 0 : strategy.many * replicates};
}

/// The contributions of a strategy to the light of an organ.
/// @param size, largest  of one
Contributions of_strategy(
    const SamplingStrategy& strategy,
    const ContributionKind& kind,
    const CountedLight& found,
    double size,
    double largest) {
    if (!kind.is_counted()) {
        return {.more = largest, .less = largest};
    }
    // Paths of a point set are so evenly distributed that with 4.96 expected nearly all replicates
    // have 5; then their spread does not show how often one has another number.
    const bool varies = strategy.by != SampledBy::paths || !found.is_alike;
    return counted(found.number(), size, largest, varies);
}

/// The contributions to both sides.
CountedLight together(const CountedLight& upper, const CountedLight& lower) {
    return {
        upper.units + lower.units, upper.squares + lower.squares, upper.is_alike && lower.is_alike};
}

/// A sum and another term.
double added(SumRule rule, double sum, double term, double weight) {
    switch (rule) {
        case SumRule::sum:
            return sum + weight * term;
        case SumRule::root_of_squares:
            return std::hypot(sum, weight * term);
        case SumRule::largest:
            return std::max(sum, weight * term);
        default:
            return std::max(sum, term);
    }
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

void Contributions::include(
    const Contributions& other, const ContributionKind& kind, double weight) {
    for_each_number(kind, [&](const ContributionNumber& row) {
        double& own = this->*row.number;
        own = added(row.rule(kind), own, other.*row.number, weight);
    });
}

ContributionSize SampledContributions::one() const {
    if (!kind.is_counted()) {
        return {all.more, all.less};
    }
    const ContributionSize unseen{all.unseen, 0};
    if (all.light == 0) {
        return unseen;
    }
    const double number = all.light / all.root * (all.light / all.root);
    const double size = all.root * (all.root / all.light);
    const double few = all.varies > 0 ? std::max(0.0, 1 - number / kind.many) : 1;
    const ContributionSize seen{few * std::max(size, all.largest / (number + 1)), few * size};
    return kind.sample == Sample::ray ? both(seen, unseen) : larger(seen, unseen);
}

ContributionSize one_contribution(std::span<const SampledContributions> kinds) {
    return one_of_kinds(
        kinds.size(), [&](std::size_t i) { return kinds[i].kind.sample; },
        [&](std::size_t i) { return kinds[i].one(); });
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
             {{Sample::point},
              {.more = all > 0 && found == all ? on_triangle : direct,
               .less = found > 0 ? direct : 0}}});
        const bool is_lit = (is_upper ? sum.scattered_upper : sum.scattered_lower) > 0;
        kinds_.push_back(
            {side,
             false,
             false,
             false,
             {{Sample::path}, {.more = scattered, .less = is_lit ? scattered : 0}}});
    }
}

void OrganContributions::read_strategies(
    const OrganReader& reader, std::size_t band, const Incident& sum) {
    const double count = reader.replicates();
    kinds_.reserve(2 * reader.sums().data().strategies.size() + 2);
    for (std::size_t i = 0; i < reader.sums().data().strategies.size(); ++i) {
        const SamplingStrategy& strategy = reader.sums().data().strategies[i];
        const ContributionKind kind = kind_of(strategy, count);
        const double flux = reader.flux_per_unit(i, band) / count;
        for (const SurfaceSide side : kSurfaceSides) {
            const CountedLight found = reader.counted(i, side);
            const bool is_seen = found.units > 0;
            const double size = is_seen ? found.units * flux / found.number() : 0;
            const double largest = reader.units_per_contribution(i, side, is_seen) * flux;
            kinds_.push_back(
                {side,
                 true,
                 strategy.has_suns,
                 strategy.spectra.size() == 1,
                 {kind, of_strategy(strategy, kind, found, size, largest)}});
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
        const ContributionKind kind{Sample::path, kManyContributions * count};
        kinds_.push_back(
            {side,
             false,
             false,
             false,
             {kind, counted(size > 0 ? std::max(0.0, mean / size) : 0, size, size, true)}});
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
        all.kinds_ = {{.sampled = {{Sample::point}, {.more = one, .less = one}}}};
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
        const double largest = one * reader.sunlit_per_contribution(i, found.units > 0);
        // Light of other suns counts in the area too.
        const double size = found.units > 0 ? std::min(area / found.number(), largest) : 0;
        const ContributionKind kind = kind_of(strategies[i], count);
        all.kinds_.push_back(
            {.sampled = {kind, of_strategy(strategies[i], kind, found, size, largest)}});
    }
    return all;
}

void OrganContributions::include(const OrganContributions& organ, double weight) {
    if (kinds_.empty()) {
        kinds_ = organ.kinds_;
        for (Kind& kind : kinds_) {
            kind.sampled.all = {};
        }
    }
    for (std::size_t i = 0; i < organ.kinds_.size(); ++i) {
        const SampledContributions& other = organ.kinds_[i].sampled;
        kinds_[i].sampled.all.include(other.all, other.kind, weight);
    }
    absorptance_ = std::max(absorptance_, organ.absorptance_);
    bound_ = std::max(bound_, organ.bound_ * weight);
    has_points_ = has_points_ || organ.has_points_;
}

template <typename SizeOf>
ContributionSize OrganContributions::combined(const SizeOf& size_of) const {
    return one_of_kinds(
        kinds_.size(), [&](std::size_t i) { return kinds_[i].sampled.kind.sample; },
        [&](std::size_t i) { return size_of(kinds_[i], i); });
}

bool OrganContributions::includes(const LightParts& parts, const Kind& kind) {
    return (kind.is_direct ? parts.direct : parts.scattered) && (parts.suns || !kind.has_suns) &&
           (kind.side == SurfaceSide::upper ? parts.upper : parts.lower);
}

std::vector<SampledContributions> OrganContributions::kinds(const LightParts& parts) const {
    std::vector<SampledContributions> included;
    for (const Kind& kind : kinds_) {
        if (includes(parts, kind)) {
            included.push_back(kind.sampled);
        }
    }
    return included;
}

ContributionSize OrganContributions::size(const LightParts& parts) const {
    const ContributionSize one = combined([&](const Kind& kind, std::size_t) {
        return includes(parts, kind) ? kind.sampled.one() : ContributionSize{};
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
        const ContributionSize one = kind.sampled.one();
        const ContributionSize of_b = below.kinds_[i].sampled.one() * ratio.mean;
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

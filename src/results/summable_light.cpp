#include "results/summable_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/checks.h"
#include "base/parallel.h"
#include "results/bounds/organ_reader.h"
#include "results/bounds/physical_bounds.h"
#include "results/organ_blocks.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

// Columns: the mean, a deviation of each replicate, these, and those of each kind of contribution.
constexpr std::size_t kArea = 0;
constexpr std::size_t kLimit = 1;        // of the light
constexpr std::size_t kEmitted = 2;      // also a limit: all light may fall on one organ
constexpr std::size_t kAbsorptance = 3;  // by which contributions are multiplied
constexpr std::size_t kBound = 4;        // largest contribution, where only this is known
constexpr std::size_t kFixedColumns = 5;

std::size_t columns_of(const ContributionKind& kind) {
    std::size_t count = 0;
    for_each_number(kind, [&](const ContributionNumber&) { ++count; });
    return count;
}

std::size_t first_fixed(const SummableColumns& columns) {
    return 1 + std::size_t{columns.replicates};
}
std::size_t first_of_kinds(const SummableColumns& columns) {
    return first_fixed(columns) + kFixedColumns;
}

/// All numbers of an organ.
struct OrganNumbers {
    std::vector<double> values;  // per replicate
    double area = 0, limit = 0, emitted = 0, absorptance = 1, bound = 0;
    std::vector<SampledContributions> kinds = {};
};

/// Puts the numbers of an entry into the columns. @param entries  their length
void put_numbers(
    const OrganNumbers& organ,
    std::size_t entry,
    std::size_t entries,
    std::vector<double>& numbers) {
    std::size_t at = entry;
    const auto put = [&](double number) {
        numbers[at] = number;
        at += entries;
    };
    const double mean = mean_of(organ.values);
    put(mean);
    for (const double value : organ.values) {
        put(value - mean);
    }
    for (const double x :
         {organ.area, organ.limit, organ.emitted, organ.absorptance, organ.bound}) {
        put(x);
    }
    for (const SampledContributions& sampled : organ.kinds) {
        for_each_number(
            sampled.kind, [&](const ContributionNumber& row) { put(sampled.all.*row.number); });
    }
}

std::vector<ContributionKind> kinds_of(const OrganNumbers& organ) {
    std::vector<ContributionKind> kinds;
    for (const SampledContributions& sampled : organ.kinds) {
        kinds.push_back(sampled.kind);
    }
    return kinds;
}

/// The light of all organs. @param read  makes the OrganNumbers of a reader and its organ
template <typename Read>
SummableLight read_organs(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    Summand summand,
    const Read& read) {
    const SumReader reader(sums);
    const std::vector<Organ>& organs = scene.organs();
    const auto numbers_of = [&](std::size_t i) {
        return read(OrganReader(reader, scene, spec, organs[i]), organs[i]);
    };
    SummableColumns columns{summand, static_cast<std::uint32_t>(sums->replicates.size()), {}};
    if (!organs.empty()) {
        columns.kinds = kinds_of(numbers_of(0));
    }
    std::vector<double> numbers(
        columns.size() * organs.size(), std::numeric_limits<double>::quiet_NaN());
    for_each_block(scene, spec.threads, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (is_measured(sums, organs[i])) {
                put_numbers(numbers_of(i), i, organs.size(), numbers);
            }
        }
    });
    return {std::move(columns), std::move(numbers)};
}

/// Terms of a weighted sum by a rule.
template <typename Number>
double folded(SumRule rule, const OrganWeights& of, const Number& number) {
    double sum = 0;
    for (std::size_t i = 0; i < of.organs.size(); ++i) {
        const double x = number(of.organs[i]), weight = of.weight(i);
        switch (rule) {
            case SumRule::sum:
                sum += weight * x;
                break;
            case SumRule::root_of_squares:
                sum += weight * x * weight * x;
                break;
            case SumRule::largest:
                sum = std::max(sum, weight * x);
                break;
            case SumRule::largest_of_all:
                sum = std::max(sum, x);
                break;
        }
    }
    return rule == SumRule::root_of_squares ? std::sqrt(sum) : sum;
}

}  // namespace

std::size_t SummableColumns::size() const {
    std::size_t all = first_of_kinds(*this);
    for (const ContributionKind& kind : kinds) {
        all += columns_of(kind);
    }
    return all;
}

SumRule SummableColumns::rule(std::size_t column) const {
    const std::size_t fixed = first_fixed(*this), of_kinds = first_of_kinds(*this);
    if (column < fixed || column == fixed + kArea || column == fixed + kLimit) {
        return SumRule::sum;
    }
    if (column < of_kinds) {
        return column == fixed + kAbsorptance ? SumRule::largest_of_all : SumRule::largest;
    }
    std::vector<SumRule> rules;
    for (const ContributionKind& kind : kinds) {
        for_each_number(
            kind, [&](const ContributionNumber& row) { rules.push_back(row.rule(kind)); });
    }
    return rules[column - of_kinds];
}

SummableLight SummableLight::of_flux(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    Quantity quantity,
    std::size_t band) {
    const LightParts& parts = parts_of(quantity);
    const PhysicalBounds bounds(scene, spec, sums->emitted_flux);
    const auto read = [&](const OrganReader& reader, const Organ& organ) {
        OrganNumbers own{.values = std::vector<double>(reader.replicates()), .area = organ.area};
        Incident all;
        for (std::uint32_t r = 0; r < own.values.size(); ++r) {
            const Incident light = reader.incident(r, band);
            own.values[r] = light.of(parts);
            all += light;
        }
        OrganLimits limits = bounds.none();
        bounds.find(organ, limits);
        own.limit = limits.light(parts, band);
        own.emitted =
            parts.is_absorbed ? limits.emitted[band] : std::numeric_limits<double>::infinity();
        const OrganContributions contributions(reader, band, all);
        own.absorptance = parts.is_absorbed ? contributions.absorptance() : 1;
        own.bound = contributions.bound();
        own.kinds = contributions.kinds(parts);
        return own;
    };
    return read_organs(sums, scene, spec, Summand::flux, read);
}

SummableLight SummableLight::of_sunlit_area(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    EXPECT(sums->units.sunlit_area > 0);
    const PhysicalBounds bounds(scene, spec, sums->emitted_flux);
    const auto read = [&](const OrganReader& reader, const Organ& organ) {
        OrganNumbers own{.values = std::vector<double>(reader.replicates()), .area = organ.area};
        for (std::uint32_t r = 0; r < own.values.size(); ++r) {
            own.values[r] = reader.sunlit_area(r);
        }
        OrganLimits limits = bounds.none();
        bounds.find(organ, limits);
        own.limit = limits.sunlit_area;
        own.emitted = std::numeric_limits<double>::infinity();
        const OrganContributions contributions = OrganContributions::sunlit(reader);
        own.bound = contributions.bound();
        own.kinds = contributions.kinds(kIncidentLight);
        return own;
    };
    return read_organs(
        sums, scene, spec,
        SumReader(sums).has_points() ? Summand::sunlit_area_by_points : Summand::sunlit_area, read);
}

SummableLight::SummableLight(SummableColumns columns, std::vector<double> numbers)
    : columns_(std::move(columns)), numbers_(std::move(numbers)) {
    EXPECT(numbers_.size() % columns_.size() == 0);
    sizes_.resize(size());
    for (std::size_t i = 0; i < size(); ++i) {
        sizes_[i] = size_of(i);
    }
}

ContributionSize SummableLight::size_of(std::size_t entry) const {
    const std::size_t fixed = first_fixed(columns_);
    const double absorptance = at(fixed + kAbsorptance, entry);
    if (const double bound = at(fixed + kBound, entry); bound > 0) {
        return {at(0, entry) == 0 ? bound * absorptance : 0, 0};
    }
    std::vector<SampledContributions> kinds;
    std::size_t column = first_of_kinds(columns_);
    for (const ContributionKind& kind : columns_.kinds) {
        Contributions all;
        for_each_number(
            kind, [&](const ContributionNumber& row) { all.*row.number = at(column++, entry); });
        kinds.push_back({kind, all});
    }
    return one_contribution(kinds) * absorptance;
}

Estimate SummableLight::estimate(std::size_t entry, std::span<const double> values) const {
    const std::size_t fixed = first_fixed(columns_);
    const double bound = at(fixed + kBound, entry);
    if (bound > 0) {
        const double one = bound * at(fixed + kAbsorptance, entry);
        return estimate_seen_or_bound(values, one * static_cast<double>(values.size()));
    }
    if (columns_.summand == Summand::flux) {
        return estimate_contributions(values, sizes_[entry]);
    }
    const double area = at(fixed + kArea, entry), per_area = area > 0 ? 1 / area : 0;
    std::vector<double> lit(values.begin(), values.end());
    for (double& each : lit) {
        each *= per_area;
    }
    const bool has_points = columns_.summand == Summand::sunlit_area_by_points;
    return scaled(estimate_sunlit_fraction(lit, sizes_[entry] * per_area, has_points), area);
}

std::vector<Estimate> SummableLight::estimates() const {
    std::vector<Estimate> all(size(), kUnknownEstimate);
    const std::size_t fixed = first_fixed(columns_);
    std::vector<double> values(columns_.replicates);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (std::isnan(at(0, i))) {
            continue;
        }
        for (std::size_t r = 0; r < values.size(); ++r) {
            values[r] = at(0, i) + at(1 + r, i);
        }
        all[i] = not_above(
            estimate(i, values), std::min(at(fixed + kEmitted, i), at(fixed + kLimit, i)));
    }
    return all;
}

SummableLight SummableLight::combined(std::span<const OrganWeights> of, unsigned threads) const {
    std::size_t terms = 0;
    for (const OrganWeights& row : of) {
        terms += row.organs.size();
    }
    // Below this a thread starts later than it would end.
    constexpr std::size_t kFewNumbers = 1 << 20;
    std::vector<double> numbers(columns_.size() * of.size());
    parallel_blocks(
        columns_.size(), terms * columns_.size() < kFewNumbers ? 1 : threads,
        [&](std::uint64_t c, unsigned) {
            const std::span<const double> own = column(c);
            const SumRule rule = columns_.rule(c);
            for (std::size_t row = 0; row < of.size(); ++row) {
                numbers[c * of.size() + row] =
                    folded(rule, of[row], [&](std::uint32_t organ) { return own[organ]; });
            }
        });
    return {columns_, std::move(numbers)};
}

SummableLight SummableLight::joined(std::span<const SummableLight* const> lights) {
    const SummableColumns& columns = lights.front()->columns_;
    std::vector<double> numbers;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        for (const SummableLight* light : lights) {
            EXPECT(light->columns_ == columns);
            const std::span<const double> own = light->column(c);
            numbers.insert(numbers.end(), own.begin(), own.end());
        }
    }
    return {columns, std::move(numbers)};
}

}  // namespace quasimc

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "results/bounds/organ_contributions.h"
#include "results/bounds/organ_reader.h"
#include "results/groups.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

constexpr std::size_t kGroupsPerBatch = 4096;

/// Light of the organs of a group together, per replicate.
struct GroupSums {
    std::vector<Incident> light;  ///< [band * replicates + replicate], flux
    std::vector<double> sunlit;   ///< [replicate], area
};

/// The size of one contribution to a group.
struct GroupContribution {
    double incident = 0, absorbed = 0;  ///< upper bound, to a single replicate
    /// Where sizes are known: the largest of any organ, if samples belong to organs; with
    /// strategies, where each organ may lack contributions of its own, the root of the sum of
    /// squares.
    std::array<ContributionSize, kQuantities> known{};
    ContributionSize on_both_sides;  ///< likewise, to all light on both sides
    /// Where no light was sampled: one direction may miss all organs, a path only one of them.
    std::array<double, kQuantities> by_sky_sample{}, by_path{};
};

/// Turns the sums of groups into estimates.
class GroupEvaluator {
  public:
    GroupEvaluator(
        const Sums& sums, const Scene& scene, const EvaluationSpec& spec, GroupResults& results)
        : sums_(sums), reader_(sums), scene_(scene), spec_(spec), results_(results) {}

    [[nodiscard]] GroupSums empty() const {
        const std::size_t replicates = sums_->replicates.size();
        return {
            std::vector<Incident>(replicates * results_.bands), std::vector<double>(replicates)};
    }

    /// Adds up the organs of a group in their order, for one replicate.
    void sum_up(std::size_t group, std::uint32_t replicate, GroupSums& sums) const {
        const std::size_t replicates = sums_->replicates.size();
        for (const std::uint32_t index : results_.groups[group].organs) {
            const OrganReader reader = reader_of(index);
            for (std::size_t b = 0; b < results_.bands; ++b) {
                sums.light[b * replicates + replicate] += reader.incident(replicate, b);
            }
            sums.sunlit[replicate] += has_sun() ? reader.sunlit_area(replicate) : 0;
        }
    }

    void evaluate(std::size_t group, const GroupSums& sums) const {
        std::vector<IncidentLight> incident;  // per band
        for (std::size_t b = 0; b < results_.bands; ++b) {
            incident.push_back(evaluate_band(group, b, sums));
        }
        for (std::size_t i = 0; i < results_.ratios; ++i) {
            results_.ratio_values[group * results_.ratios + i] = estimate_light_ratio(
                incident[spec_.ratios[i].first], incident[spec_.ratios[i].second]);
        }
        if (has_sun()) {
            const double area = results_.groups[group].area;
            const Estimate sunlit = sunlit_area(group, sums.sunlit);
            results_.sunlit_area[group] = sunlit;
            results_.sunlit_fraction[group] = scaled(sunlit, area > 0 ? 1 / area : 0);
        }
    }

  private:
    [[nodiscard]] bool has_sun() const { return !results_.sunlit_fraction.empty(); }

    /// Whether the unoccluded light is known.
    [[nodiscard]] bool knows_unoccluded() const { return reader_.unoccluded().exists(); }

    /// Whether the size of contributions is known.
    [[nodiscard]] bool knows_contributions() const {
        return knows_unoccluded() || !sums_->strategies.empty();
    }

    [[nodiscard]] Estimate sunlit_area(
        std::size_t group, const std::vector<double>& per_replicate) const {
        double most = 0;
        ContributionSize known;
        for (const std::uint32_t index : results_.groups[group].organs) {
            const OrganReader reader = reader_of(index);
            most = std::max(most, reader.largest_sunlit());
            if (knows_contributions() && !knows_unoccluded()) {
                known = together(known, OrganContributions::sunlit_contribution(reader));
            }
        }
        if (!knows_unoccluded()) {
            return knows_contributions() ? estimate_contributions(per_replicate, known)
                                         : estimate_seen_or_bound(per_replicate, most);
        }
        return estimate_sunlit_points(
            per_replicate, results_.groups[group].area,
            most / static_cast<double>(per_replicate.size()));
    }

    [[nodiscard]] OrganReader reader_of(std::uint32_t organ) const {
        return {reader_, scene_, spec_, scene_.organs()[organ]};
    }

    /// Combines contributions of organs: the largest if samples belong to organs, else the root of
    /// the sum of squares.
    [[nodiscard]] ContributionSize together(
        const ContributionSize& a, const ContributionSize& b) const {
        if (b.more == 0 && b.less == 0) {
            return a;
        }
        return knows_unoccluded()
                   ? ContributionSize{std::max(a.more, b.more), std::max(a.less, b.less)}
                   : ContributionSize{std::hypot(a.more, b.more), std::hypot(a.less, b.less)};
    }

    [[nodiscard]] GroupContribution contribution_of(std::size_t group, std::size_t band) const {
        GroupContribution most;
        for (const std::uint32_t index : results_.groups[group].organs) {
            const OrganReader reader = reader_of(index);
            const double contribution = reader.largest_direct(band);
            most.incident = std::max(most.incident, contribution);
            most.absorbed =
                std::max(most.absorbed, contribution * reader.largest_absorptance(band));
            const OrganContributions contributions(reader, band);
            if (contributions.has_enough_contributions()) {
                continue;
            }
            most.on_both_sides =
                together(most.on_both_sides, contributions.incident_contribution());
            for (const QuantityEntry& entry : quantity_table()) {
                if (contributions.knows_contributions()) {
                    ContributionSize& known = most.known[static_cast<std::size_t>(entry.quantity)];
                    known = together(known, contributions.contribution(entry.quantity));
                    const OrganContributions::Parts parts = contributions.parts(entry.quantity);
                    const auto q = static_cast<std::size_t>(entry.quantity);
                    most.by_sky_sample[q] += parts.by_sky_sample.more;
                    most.by_path[q] = std::max(most.by_path[q], parts.by_path.more);
                }
            }
        }
        return most;
    }

    /// @returns the light that falls on both sides, as flux
    IncidentLight evaluate_band(std::size_t group, std::size_t band, const GroupSums& sums) const {
        const double area = results_.groups[group].area;
        const double per_area = area > 0 ? 1 / area : 0;
        const GroupContribution contribution = contribution_of(group, band);
        const std::size_t replicates = sums_->replicates.size();
        QuantitySamples samples;
        samples.fill(std::vector<double>(replicates));
        IncidentLight incident{{}, contribution.on_both_sides};
        for (std::uint32_t r = 0; r < replicates; ++r) {
            const Incident& in = sums.light[band * replicates + r];
            put_sample(r, in, per_area, samples);
            incident.per_replicate.push_back(
                in.direct_upper + in.direct_lower + in.scattered_upper + in.scattered_lower);
        }
        for (const QuantityEntry& entry : quantity_table()) {
            const double unit = entry.is_flux ? 1 : per_area;
            const bool is_absorbed = parts_of(entry.quantity).is_absorbed;
            const double most =
                (is_absorbed ? contribution.absorbed : contribution.incident) * unit;
            const auto q = static_cast<std::size_t>(entry.quantity);
            const bool is_dark = std::all_of(
                samples[q].begin(), samples[q].end(), [](double light) { return light == 0; });
            const ContributionSize known =
                is_dark
                    ? ContributionSize{std::hypot(contribution.by_sky_sample[q], contribution.by_path[q]) * unit, 0}
                    : ContributionSize{
                          contribution.known[q].more * unit, contribution.known[q].less * unit};
            results_.values[(group * kQuantities + q) * results_.bands + band] =
                knows_contributions() ? estimate_contributions(samples[q], known)
                                      : estimate_seen_or_bound(samples[q], most);
        }
        return incident;
    }

    const Sums& sums_;
    SumReader reader_;
    const Scene& scene_;
    const EvaluationSpec& spec_;
    GroupResults& results_;
};

/// Groups with room for all their estimates.
GroupResults empty_groups(const Scene& scene, const GroupSpec& spec, std::size_t ratios) {
    GroupResults results;
    results.groups = make_groups(scene, spec);
    results.bands = scene.bands().size();
    results.ratios = ratios;
    const std::size_t count = results.groups.size();
    results.values.resize(count * kQuantities * results.bands);
    results.ratio_values.resize(count * ratios);
    return results;
}

}  // namespace

GroupResults evaluate_groups(const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    GroupResults results = empty_groups(scene, spec.groups, spec.ratios.size());
    const std::size_t count = results.groups.size();
    if (sums->units.sunlit_area > 0) {
        results.sunlit_fraction.resize(count);
        results.sunlit_area.resize(count);
    }
    const GroupEvaluator evaluator(sums, scene, spec, results);
    const std::size_t replicates = sums->replicates.size();
    for (std::size_t first = 0; first < count; first += kGroupsPerBatch) {
        const std::size_t batch = std::min(kGroupsPerBatch, count - first);
        std::vector<GroupSums> of_groups(batch, evaluator.empty());
        parallel_blocks(batch * replicates, spec.threads, [&](std::uint64_t block, unsigned) {
            const std::size_t i = block / replicates;
            evaluator.sum_up(
                first + i, static_cast<std::uint32_t>(block % replicates), of_groups[i]);
        });
        parallel_blocks(batch, spec.threads, [&](std::uint64_t i, unsigned) {
            evaluator.evaluate(first + i, of_groups[i]);
        });
    }
    return results;
}

GroupResults zero_groups(const Scene& scene, const GroupSpec& spec, std::size_t ratios) {
    GroupResults dark = empty_groups(scene, spec, ratios);
    std::fill(dark.ratio_values.begin(), dark.ratio_values.end(), kUnknownEstimate);
    return dark;
}

}  // namespace quasimc

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "results/combine.h"
#include "results/groups.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

constexpr std::size_t kGroupsPerBatch = 4096;

/// Turns the sums of groups into estimates.
class GroupEvaluator {
  public:
    GroupEvaluator(
        const Sums& sums,
        const Scene& scene,
        const EvaluationSpec& spec,
        const std::vector<std::vector<double>>& incident,
        GroupResults& results)
        : combiner_(sums, scene, spec), spec_(spec), incident_(incident), results_(results) {}

    /// Sets the denominators of shares. @param all  sums of the group of all organs
    void set_all(const CombinedLight& all) {
        const std::size_t replicates = combiner_.replicates();
        absorbed_by_all_.assign(results_.bands, std::vector<double>(replicates));
        for (std::size_t b = 0; b < results_.bands; ++b) {
            for (std::size_t r = 0; r < replicates; ++r) {
                absorbed_by_all_[b][r] = absorbed(all.light[b * replicates + r]);
            }
        }
    }

    [[nodiscard]] CombinedLight empty() const { return combiner_.empty(); }

    /// Adds up the organs of a group in their order, for one replicate.
    void sum_up(std::size_t group, std::uint32_t replicate, CombinedLight& sums) const {
        combiner_.add_up(organs_of(group), replicate, sums);
    }

    void evaluate(std::size_t group, const CombinedLight& sums) const {
        const std::vector<OrganContributions> contributions =
            combiner_.contributions(organs_of(group));
        std::vector<std::vector<double>> incident(results_.bands);
        for (std::size_t b = 0; b < results_.bands; ++b) {
            incident[b] = evaluate_band(group, b, sums, contributions[b]);
        }
        for (std::size_t i = 0; i < results_.ratios; ++i) {
            const auto [above, below] = spec_.ratios[i];
            results_.ratio_values[group * results_.ratios + i] = OrganContributions::estimate_ratio(
                contributions[above], contributions[below], incident[above], incident[below]);
        }
        if (has_sun()) {
            const double area = results_.groups[group].area;
            std::vector<double> lit = sums.sunlit;
            for (double& each : lit) {
                each *= area > 0 ? 1 / area : 0;
            }
            const Estimate sunlit =
                combiner_.sunlit_contributions(organs_of(group)).estimate_sunlit(area, lit);
            results_.sunlit_fraction[group] = sunlit;
            results_.sunlit_area[group] = scaled(sunlit, area);
        }
    }

  private:
    [[nodiscard]] bool has_sun() const { return !results_.sunlit_fraction.empty(); }

    [[nodiscard]] OrganWeights organs_of(std::size_t group) const {
        return {results_.groups[group].organs};
    }

    /// The flux that a group absorbs in a replicate.
    static double absorbed(const Incident& in) {
        return quantities_of(in, 1)[static_cast<std::size_t>(Quantity::absorbed_flux)];
    }

    /// Shares of a band, replicate by replicate. @param flux  that the group absorbs
    void evaluate_shares(
        std::size_t group,
        std::size_t band,
        const std::vector<double>& flux,
        const ContributionSize& one) const {
        const auto put = [&](GroupShare share, const Estimate& estimate) {
            const auto index = static_cast<std::size_t>(share);
            results_.shares[(group * kGroupShares + index) * results_.bands + band] = estimate;
        };
        if (!incident_.empty()) {
            put(GroupShare::incident, estimate_share(flux, incident_[band], one));
        }
        put(GroupShare::absorbed, share_of_all(flux, absorbed_by_all_[band], one));
    }

    /// @returns the light that falls on both sides, per replicate
    std::vector<double> evaluate_band(
        std::size_t group,
        std::size_t band,
        const CombinedLight& sums,
        const OrganContributions& contributions) const {
        const double area = results_.groups[group].area;
        const double per_area = area > 0 ? 1 / area : 0;
        const QuantitySamples samples = combiner_.samples(sums, band, per_area);
        std::vector<double> incident;
        for (std::size_t r = 0; r < combiner_.replicates(); ++r) {
            incident.push_back(sums.light[band * combiner_.replicates() + r].of(kIncidentLight));
        }
        for (const QuantityEntry& entry : quantity_table()) {
            const auto q = static_cast<std::size_t>(entry.quantity);
            results_.values[(group * kQuantities + q) * results_.bands + band] =
                contributions.estimate(entry, per_area, samples[q]);
        }
        const auto& flux = samples[static_cast<std::size_t>(Quantity::absorbed_flux)];
        evaluate_shares(group, band, flux, contributions.size(Quantity::absorbed_flux, flux));
        return incident;
    }

    LightCombiner combiner_;
    const EvaluationSpec& spec_;
    const std::vector<std::vector<double>>& incident_;
    std::vector<std::vector<double>> absorbed_by_all_;  // [band][replicate]
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
    results.shares.resize(count * kGroupShares * results.bands, kUnknownEstimate);
    return results;
}

}  // namespace

Estimate share_of_all(
    std::span<const double> flux, std::span<const double> all, const ContributionSize& one) {
    const double whole = mean_of(all), rest = whole > 0 ? 1 - mean_of(flux) / whole : 1;
    return not_above(estimate_share(flux, all, one * std::max(0.0, rest)), 1);
}

GroupResults evaluate_groups(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    const std::vector<std::vector<double>>& incident) {
    GroupResults results = empty_groups(scene, spec.groups, spec.ratios.size());
    const std::size_t count = results.groups.size();
    if (sums->units.sunlit_area > 0) {
        results.sunlit_fraction.resize(count);
        results.sunlit_area.resize(count);
    }
    GroupEvaluator evaluator(sums, scene, spec, incident, results);
    const std::size_t replicates = sums->replicates.size();
    for (std::size_t first = 0; first < count; first += kGroupsPerBatch) {
        const std::size_t batch = std::min(kGroupsPerBatch, count - first);
        std::vector<CombinedLight> of_groups(batch, evaluator.empty());
        parallel_blocks(batch * replicates, spec.threads, [&](std::uint64_t block, unsigned) {
            const std::size_t i = block / replicates;
            evaluator.sum_up(
                first + i, static_cast<std::uint32_t>(block % replicates), of_groups[i]);
        });
        if (first == 0) {
            evaluator.set_all(of_groups.front());
        }
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

#include "results/totals.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "results/bounds/organ_contributions.h"
#include "results/flows.h"
#include "results/groups.h"
#include "results/organ_blocks.h"
#include "scene/lint.h"
#include "sums/sum_data.h"

namespace quasimc {
namespace {

/// Upper bound of the total absorbed by organs, or by the ground, with zero contributions: the
/// largest bound of one organ, for a sample contributes to at most one of them.
void bound_unseen_totals(const Scene& scene, Result& result) {
    for (std::size_t b = 0; b < result.bands; ++b) {
        double organs = 0, ground = 0;
        for (std::size_t i = 0; i < scene.organs().size(); ++i) {
            double& most = scene.organs()[i].is_ground ? ground : organs;
            most = std::max(most, result.at(i, Quantity::absorbed_flux, b).ci95_high);
        }
        const auto bound = [](Estimate& total, double high) {
            if (total.mean == 0 && high > 0) {
                total = {0, std::numeric_limits<double>::quiet_NaN(), 0, high};
            }
        };
        bound(result.budget[b].absorbed_by_organs, organs);
        bound(result.budget[b].absorbed_by_ground, ground);
    }
}

/// Widens a total with contributions. @param per_flux  its unit
void widen(Estimate& total, const ContributionSize& contribution, double per_flux = 1) {
    if (total.mean > 0) {
        total = widened(total, {contribution.more * per_flux, contribution.less * per_flux});
    }
}

/// An interval that contains its mean. The means of a budget's parts add up to the emitted flux;
/// one may exceed its limit by chance, and is reported as it is.
Estimate with_mean(const Estimate& e) {
    return {e.mean, e.standard_error, std::min(e.ci95_low, e.mean), std::max(e.ci95_high, e.mean)};
}

/// Includes one contribution to each organ in those to the totals.
void include_organs(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    TotalContributions& contributions) {
    const SumReader reader(sums);
    for_each_block(scene, spec.threads, [&](std::size_t first, std::size_t last) {
        std::vector<TotalContribution> own(sums->bands());
        for (std::size_t i = first; i < last; ++i) {
            const Organ& organ = scene.organs()[i];
            for (std::size_t b = 0; is_measured(sums, organ) && b < own.size(); ++b) {
                const ContributionSize size =
                    OrganContributions(OrganReader(reader, scene, spec, organ), b)
                        .size(parts_of(Quantity::absorbed_flux));
                own[b].include(
                    organ.is_ground ? TotalContribution{{}, size} : TotalContribution{size, {}});
            }
        }
        contributions.include(own);
    });
}

/// A part of the flows: [band][replicate].
std::vector<std::vector<double>> values_of(const BandFlows& flows, double Flows::*part) {
    std::vector<std::vector<double>> values(flows.size());
    for (std::size_t b = 0; b < flows.size(); ++b) {
        for (const Flows& one : flows[b]) {
            values[b].push_back(one.*part);
        }
    }
    return values;
}

/// A total without the size of a contribution. @param values  [band][replicate]
TotalReplicates total_of(std::string_view name, const std::vector<std::vector<double>>& values) {
    TotalReplicates total{name, {}, std::vector<ContributionSize>(values.size())};
    for (std::size_t r = 0; r < values.front().size(); ++r) {
        for (const std::vector<double>& band : values) {
            total.values.push_back(band[r]);
        }
    }
    return total;
}

}  // namespace

std::vector<TotalReplicates> replicates_of_totals(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    const BandFlows flows = read_flows(sums, scene);
    const auto part = [&](std::string_view name, double Flows::*of) {
        return total_of(name, values_of(flows, of));
    };
    TotalReplicates organs = part("absorbed_by_organs", &Flows::organs);
    TotalReplicates ground = part("absorbed_by_ground", &Flows::ground);
    TotalContributions contributions(sums->bands());
    include_organs(sums, scene, spec, contributions);
    for (std::size_t b = 0; b < flows.size(); ++b) {
        organs.sizes[b] = contributions.of(b).organs;
        ground.sizes[b] = contributions.of(b).ground;
    }
    std::vector<TotalReplicates> all{
        part("emitted", &Flows::emitted),
        std::move(organs),
        std::move(ground),
        part("escaped", &Flows::escaped),
        part("cut_off", &Flows::cut_off),
        part("imbalance", &Flows::imbalance)};
    const std::vector<std::vector<double>> incident = horizontal_flux(flows, scene, spec);
    if (!incident.empty()) {
        all.push_back(total_of("incident", incident));
    }
    if (!incident.empty() && ground_of(scene) != nullptr) {
        all.push_back(part("reflected", reflected_flux(scene)));
        all.push_back(part("transmitted", &Flows::on_ground));
    }
    return all;
}

void TotalContribution::include(const TotalContribution& other) {
    organs = larger(organs, other.organs);
    ground = larger(ground, other.ground);
}

void TotalContributions::include(std::span<const TotalContribution> some) {
    const std::lock_guard lock(mutex_);
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        bands_[b].include(some[b]);
    }
}

void report_errors_of_totals(
    const Sums& sums, const Scene& scene, const TotalContributions& contributions, Result& result) {
    bound_unseen_totals(scene, result);
    for (std::size_t b = 0; b < result.bands; ++b) {
        const TotalContribution& contribution = contributions.of(b);
        BandBudget& budget = result.budget[b];
        widen(budget.absorbed_by_organs, contribution.organs);
        widen(budget.absorbed_by_ground, contribution.ground);
        if (!result.canopy.empty() && result.canopy[b].incident > 0) {
            CanopyFractions& canopy = result.canopy[b];
            widen(canopy.absorptance, contribution.organs, 1 / canopy.incident);
            widen(canopy.ground_absorptance, contribution.ground, 1 / canopy.incident);
        }
        // Where all emitted light is counted, no part exceeds it.
        for (Estimate* part :
             {&budget.absorbed_by_organs, &budget.absorbed_by_ground, &budget.escaped}) {
            *part = with_mean(
                sums->emitted_flux.empty() ? *part : not_above(*part, sums->emitted_flux[b]));
        }
    }
}

}  // namespace quasimc

#include "results/totals.h"

#include <algorithm>
#include <limits>

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

}  // namespace

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

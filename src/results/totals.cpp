#include "results/totals.h"

#include <algorithm>
#include <limits>

#include "sums/sum_data.h"

namespace quasimc {
namespace {

/// The upper bound of what organs, or the ground, absorb together, where nothing was found: that of
/// the one with the largest, for a sample finds one of them at most.
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

/// Widens a total of which something was found. @param per_flux  its unit
void widen(Estimate& total, const ContributionSize& find, double per_flux = 1) {
    if (total.mean > 0) {
        total = widened(total, {find.more * per_flux, find.less * per_flux});
    }
}

/// An interval that holds its mean. The parts of a budget add up to what is emitted by their means,
/// one of which may lie beyond what is possible by chance: these are reported as they are.
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
    const Sums& sums, const Scene& scene, const TotalContributions& finds, Result& result) {
    bound_unseen_totals(scene, result);
    for (std::size_t b = 0; b < result.bands; ++b) {
        const TotalContribution& find = finds.of(b);
        BandBudget& budget = result.budget[b];
        widen(budget.absorbed_by_organs, find.organs);
        widen(budget.absorbed_by_ground, find.ground);
        if (!result.canopy.empty() && result.canopy[b].incident > 0) {
            CanopyFractions& canopy = result.canopy[b];
            widen(canopy.absorptance, find.organs, 1 / canopy.incident);
            widen(canopy.ground_absorptance, find.ground, 1 / canopy.incident);
        }
        // Where all light that is emitted goes, no part gets more.
        for (Estimate* part :
             {&budget.absorbed_by_organs, &budget.absorbed_by_ground, &budget.escaped}) {
            *part = with_mean(
                sums->emitted_flux.empty() ? *part : not_above(*part, sums->emitted_flux[b]));
        }
    }
}

}  // namespace quasimc

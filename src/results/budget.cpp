#include <algorithm>
#include <cmath>

#include "results/flows.h"
#include "results/totals.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

/// An interval that contains its mean. The means of a budget's parts add up to the emitted flux;
/// one may exceed its limit by chance, and is reported as it is.
Estimate with_mean(const Estimate& e) {
    return {e.mean, e.standard_error, std::min(e.ci95_low, e.mean), std::max(e.ci95_high, e.mean)};
}

}  // namespace

std::vector<BandBudget> evaluate_budget(
    const BandFlows& all_flows,
    std::span<const TotalSizes> sizes,
    std::span<const double> emitted) {
    std::vector<BandBudget> budget;
    for (std::size_t b = 0; b < all_flows.size(); ++b) {
        const std::vector<Flows>& flows = all_flows[b];
        double worst = 0;
        for (const Flows& f : flows) {
            const double open =
                f.emitted + f.imbalance - f.organs - f.ground - f.escaped - f.cut_off;
            worst = std::max(worst, f.emitted > 0 ? std::abs(open) / f.emitted : 0);
        }
        const auto amount = [&](double Flows::*part, const ContributionSize& one = {}) {
            return estimate_contributions(values_of(flows, part), one);
        };
        const auto at_most_emitted = [&](const Estimate& part) {
            return with_mean(emitted.empty() ? part : not_above(part, emitted[b]));
        };
        budget.push_back(
            {.emitted = amount(&Flows::emitted),
             .absorbed_by_organs = at_most_emitted(amount(&Flows::organs, sizes[b].organs)),
             .absorbed_by_ground = at_most_emitted(amount(&Flows::ground, sizes[b].ground)),
             .escaped = at_most_emitted(amount(&Flows::escaped)),
             .cut_off = amount(&Flows::cut_off),
             .imbalance = estimate_mean(values_of(flows, &Flows::imbalance)),
             .closure_error = worst});
    }
    return budget;
}

}  // namespace quasimc

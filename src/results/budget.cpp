#include <algorithm>
#include <cmath>

#include "results/flows.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

Estimate estimate_of(const std::vector<Flows>& flows, double Flows::*part) {
    std::vector<double> values;
    values.reserve(flows.size());
    for (const Flows& one : flows) {
        values.push_back(one.*part);
    }
    return estimate_mean(values);
}

}  // namespace

std::vector<BandBudget> evaluate_budget(const BandFlows& all_flows) {
    std::vector<BandBudget> budget;
    for (const std::vector<Flows>& flows : all_flows) {
        double worst = 0;
        for (const Flows& f : flows) {
            const double open =
                f.emitted + f.imbalance - f.organs - f.ground - f.escaped - f.cut_off;
            worst = std::max(worst, f.emitted > 0 ? std::abs(open) / f.emitted : 0);
        }
        const auto amount = [&](double Flows::*part) {
            return not_negative(estimate_of(flows, part));
        };
        budget.push_back(
            {.emitted = amount(&Flows::emitted),
             .absorbed_by_organs = amount(&Flows::organs),
             .absorbed_by_ground = amount(&Flows::ground),
             .escaped = amount(&Flows::escaped),
             .cut_off = amount(&Flows::cut_off),
             .imbalance = estimate_of(flows, &Flows::imbalance),
             .closure_error = worst});
    }
    return budget;
}

}  // namespace quasimc

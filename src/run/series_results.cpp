// Results of times of a series that were not traced.

#include <limits>

#include "quasimc/series.h"
#include "results/evaluate.h"
#include "results/flows.h"
#include "results/groups.h"

namespace quasimc {

Result scaled(const Result& result, double factor) {
    Result copy = result;
    for (Estimate& estimate : copy.values) {
        estimate = scaled(estimate, factor);
    }
    for (Estimate& estimate : copy.groups.values) {
        estimate = scaled(estimate, factor);
    }
    for (CanopyFractions& band : copy.canopy) {
        band.incident *= factor;
    }
    for (BandBudget& band : copy.budget) {
        for (Estimate BandBudget::*part :
             {&BandBudget::emitted, &BandBudget::absorbed_by_organs,
              &BandBudget::absorbed_by_ground, &BandBudget::escaped, &BandBudget::cut_off,
              &BandBudget::roulette}) {
            band.*part = scaled(band.*part, factor);
        }
    }
    for (DetectorResult& detector : copy.detectors) {
        for (Estimate& estimate : detector.values) {
            estimate = scaled(estimate, factor);
        }
    }
    if (copy.audit) {
        for (BandAudit& band : copy.audit->bands) {
            band.difference *= factor;
            band.standard_error *= factor;
        }
    }
    return copy;
}

Result dark_result(const Scene& scene, const RunSpec& spec) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    Result dark;
    dark.bands = scene.bands().size();
    dark.ratios = spec.ratios.size();
    dark.values.resize(scene.organs().size() * kQuantities * dark.bands);
    dark.ratio_values.resize(scene.organs().size() * dark.ratios, {kNan, kNan, kNan, kNan});
    dark.groups = dark_groups(scene, group_spec(spec), dark.ratios);
    dark.budget.resize(dark.bands);
    dark.canopy = dark_canopy(scene);
    dark.detectors = dark_detectors(scene);
    dark.replicates = spec.replicates;
    dark.chosen.reason = "it is dark, nothing was traced";
    return dark;
}

}  // namespace quasimc

// The result of a time step whose light is a multiple of another's.

#include "quasimc/series.h"
#include "results/evaluate.h"
#include "results/flows.h"
#include "results/groups.h"

namespace quasimc {
namespace {

/// Scales all but fractions.
void scale_light(SunShadeLight& light, double factor) {
    for (std::size_t i = 0; i < light.values.size(); ++i) {
        const SunShadeEntry& entry = sun_shade_table()[i / light.bands % kSunShadeQuantities];
        light.values[i] = scaled(light.values[i], entry.has_bands() ? factor : 1);
    }
}

}  // namespace

Result scaled(const Result& result, double factor) {
    Result copy = result;
    for (Estimate& estimate : copy.values) {
        estimate = scaled(estimate, factor);
    }
    for (Estimate& estimate : copy.groups.values) {
        estimate = scaled(estimate, factor);
    }
    scale_light(copy.sun_shade, factor);
    scale_light(copy.groups.sun_shade, factor);
    for (CanopyFractions& band : copy.canopy) {
        band.incident *= factor;
    }
    for (BandBudget& band : copy.budget) {
        for (Estimate BandBudget::*part :
             {&BandBudget::emitted, &BandBudget::absorbed_by_organs,
              &BandBudget::absorbed_by_ground, &BandBudget::escaped, &BandBudget::cut_off,
              &BandBudget::imbalance}) {
            band.*part = scaled(band.*part, factor);
        }
    }
    for (DetectorResult& detector : copy.detectors) {
        for (Estimate& estimate : detector.values) {
            estimate = scaled(estimate, factor);
        }
    }
    for (OriginLight& origin : copy.origins) {
        origin.light = scaled(origin.light, factor);
    }
    if (copy.sensors) {
        copy.sensors = std::make_shared<const Result>(scaled(*copy.sensors, factor));
    }
    if (copy.audit) {
        for (BandAudit& band : copy.audit->bands) {
            band.difference *= factor;
            band.standard_error *= factor;
        }
    }
    return copy;
}

}  // namespace quasimc

#pragma once

#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"

namespace quasimc {

/// Where the light of one band went, as one replicate saw it: flux.
struct Flows {
    double emitted = 0, organs = 0, ground = 0, escaped = 0, cut_off = 0, imbalance = 0;
    double on_ground = 0;          ///< what falls on the ground
    double escaped_scattered = 0;  ///< of what escaped; NaN where escaped is a remainder
};

/// [band][replicate]
using BandFlows = std::vector<std::vector<Flows>>;

[[nodiscard]] BandFlows read_flows(const Sums& sums, const Scene& scene);

/// The energy budget of each band.
[[nodiscard]] std::vector<BandBudget> evaluate_budget(const BandFlows& flows);

/// The fractions of each band (Result::canopy).
[[nodiscard]] std::vector<CanopyFractions> evaluate_canopy(
    const BandFlows& flows, const Sums& sums, const Scene& scene, const EvaluationSpec& spec);
/// The same of a scene without light: fractions that are NaN.
[[nodiscard]] std::vector<CanopyFractions> dark_canopy(const Scene& scene);

}  // namespace quasimc

#pragma once

#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"

namespace quasimc {

/// The light of each of the scene's detectors, as part of evaluate().
[[nodiscard]] std::vector<DetectorResult> evaluate_detectors(const Sums& sums, const Scene& scene);
/// Detectors of a scene without light: zeros.
[[nodiscard]] std::vector<DetectorResult> zero_detectors(const Scene& scene);

/// The statistical errors of the absorbed light of organs. The caller sets the time.
/// @param target  relative standard error, in every band; 0: none
[[nodiscard]] RoundErrors errors_so_far(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec, double target);

/// The scatter of the light of organs between replicates, relative to their mean light: root mean
/// square of standard errors, in the worst band. Without the light that was not sampled.
[[nodiscard]] double pooled_error(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec);

}  // namespace quasimc

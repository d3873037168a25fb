#pragma once

#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"

namespace quasimc {

/// What each of the scene's detectors saw, as part of evaluate().
[[nodiscard]] std::vector<DetectorResult> evaluate_detectors(const Sums& sums, const Scene& scene);
/// The same of a scene without light: zeros.
[[nodiscard]] std::vector<DetectorResult> dark_detectors(const Scene& scene);

/// How well the light that organs absorb is known. Its time is left to the caller.
/// @param target  relative standard error, in every band; 0: none
[[nodiscard]] RoundErrors errors_so_far(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec, double target);

}  // namespace quasimc

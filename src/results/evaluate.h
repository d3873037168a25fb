#pragma once

#include <limits>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"

namespace quasimc {

/// What each of the scene's detectors saw, as part of evaluate().
[[nodiscard]] std::vector<DetectorResult> evaluate_detectors(const Sums& sums, const Scene& scene);
/// The same of a scene without light: zeros.
[[nodiscard]] std::vector<DetectorResult> dark_detectors(const Scene& scene);

/// Fraction of the organs whose absorbed flux has at most `target` relative standard error in every
/// band.
[[nodiscard]] double fraction_at_target(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec, double target);

/// Relative standard errors of the flux that organs absorb, over organs (without the ground) and
/// bands in which light was found; NaN if there are none.
struct ErrorSpread {
    double median = std::numeric_limits<double>::quiet_NaN();
    double worst = std::numeric_limits<double>::quiet_NaN();
};
[[nodiscard]] ErrorSpread spread_of_errors(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec);

}  // namespace quasimc

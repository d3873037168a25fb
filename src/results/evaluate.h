#pragma once

#include <utility>
#include <vector>

#include "results/result.h"
#include "scene/scene.h"
#include "solvers/run_spec.h"
#include "sums/sums.h"

namespace quasimc {

/// What is to be made of sums.
struct EvaluationSpec {
    std::vector<std::pair<std::size_t, std::size_t>> ratios = {};  ///< pairs of bands
    DirectLight direct_light = DirectLight::counted;
    unsigned threads = 1;  ///< never changes a number
};

/// What the sums of a run say of each organ, ratio and band, with errors from the replicates: a
/// pure function. Fills everything of the result but how it was found (Result::chosen, stop,
/// times).
/// @param sums  of at least one path
/// @param scene  that they were computed for
[[nodiscard]] Result evaluate(const Sums& sums, const Scene& scene, const EvaluationSpec& spec);

/// The energy budget of each band, as part of the above.
[[nodiscard]] std::vector<BandBudget> evaluate_budget(const Sums& sums, const Scene& scene);

/// What each of the scene's detectors saw, as part of the above.
[[nodiscard]] std::vector<DetectorResult> evaluate_detectors(const Sums& sums, const Scene& scene);
/// The same of a scene without light: zeros.
[[nodiscard]] std::vector<DetectorResult> dark_detectors(const Scene& scene);

/// Fraction of the organs whose absorbed flux has at most `target` relative standard error in every
/// band.
[[nodiscard]] double fraction_at_target(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec, double target);

}  // namespace quasimc

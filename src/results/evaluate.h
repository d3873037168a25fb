#pragma once

#include <limits>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"

namespace quasimc {

/// The light of each of the scene's detectors, as part of evaluate().
[[nodiscard]] std::vector<DetectorResult> evaluate_detectors(const Sums& sums, const Scene& scene);
/// Detectors of a scene without light: zeros.
[[nodiscard]] std::vector<DetectorResult> zero_detectors(const Scene& scene);

/// The groups of sums, as evaluate() makes them. @param spec  with groups that check_groups()
/// accepts
[[nodiscard]] GroupResults groups_of_sums(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec);

/// The options by which the sums of one origin of light (of_origin()) are evaluated.
/// @param spec  options of the sums of all of them
[[nodiscard]] EvaluationSpec evaluation_of_origin(const EvaluationSpec& spec, std::size_t origin);

/// A target of relative standard errors (RunSpec::target_error, target_fraction).
struct TargetLevel {
    double error = 0;  ///< 0: none
    double fraction = 1;
};

/// The errors of the light of EvaluationSpec::question, and how far they are from a target.
struct ErrorsSoFar {
    RoundErrors round;  ///< without its time
    /// The smallest error that the fraction of the target does not exceed, over the target: at most
    /// 1 where it is reached. Infinite without a target, and where too little light was sampled.
    double ratio_to_target = std::numeric_limits<double>::infinity();
};
[[nodiscard]] ErrorsSoFar errors_so_far(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec, const TargetLevel& target);

/// One relative error of the light of EvaluationSpec::question, to compare methods with: the root
/// of the mean squared standard error over its mean, over organs (or groups, ...) of equal weight;
/// the largest of all bands, and of organs and sensors. The standard errors are the scatter of the
/// replicates, at least two, without the size of a contribution. Bands that the sources do not emit
/// are left out. Infinite where no light was sampled.
[[nodiscard]] double pooled_error(const Sums& sums, const Scene& scene, const EvaluationSpec& spec);

}  // namespace quasimc

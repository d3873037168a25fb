#pragma once

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"

namespace quasimc {

/// Of what evaluate() tells of organs, groups, totals and ratios the means alone, in a part of its
/// time: how another result differs tells an error. Errors and intervals are not a number; of
/// sunlit parts and detectors nothing is told.
/// @param sums  of one replicate (coarser_sums())
/// @param groups  that the other result has; none are made for this one
[[nodiscard]] Result evaluate_means(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    const std::vector<OrganGroup>& groups);

}  // namespace quasimc

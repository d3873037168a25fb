#pragma once

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"

namespace quasimc {

/// The means alone of organs, groups, totals and ratios, in a fraction of the time of evaluate():
/// the difference from another result estimates an error. Standard errors and intervals are NaN;
/// sunlit fractions and detectors are left out.
/// @param sums  sums of one replicate (coarser_sums())
/// @param groups  groups of the other result; none are made for this one
[[nodiscard]] Result evaluate_means(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    const std::vector<OrganGroup>& groups);

}  // namespace quasimc

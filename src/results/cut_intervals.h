#pragma once

#include "quasimc/result.h"
#include "results/bounds/physical_bounds.h"
#include "scene/scene.h"

namespace quasimc {

/// Clips all intervals of a result to the physically possible values (docs/theory/statistics.md),
/// after every step that widens them. Means stay; reported() moves them into the interval.
void cut_intervals(
    const PhysicalBounds& limits, const Scene& scene, const EvaluationSpec& spec, Result& result);
/// The same of groups alone.
void cut_groups(
    const PhysicalBounds& limits,
    const Scene& scene,
    const EvaluationSpec& spec,
    GroupResults& all);

}  // namespace quasimc

#pragma once

#include "quasimc/result.h"
#include "results/bounds/physical_bounds.h"
#include "scene/scene.h"

namespace quasimc {

/// Ends all intervals of a result at what is physically possible (docs/theory/statistics.md), after
/// all else that makes them wider. Means stay what they are; reported() puts them into the
/// interval.
void cut_intervals(
    const PhysicalBounds& limits, const Scene& scene, const EvaluationSpec& spec, Result& result);

}  // namespace quasimc

#pragma once

#include <stop_token>

#include "light/models/source.h"
#include "planner/planner.h"
#include "quasimc/run_spec.h"
#include "run/cached_ray_caster.h"
#include "scene/scene.h"

namespace quasimc {

/// plan_method(), which asks the caster whether so many surfaces cross that bundles can't be used,
/// and what lines across an endless stand cost under its suns.
/// @throws StopRequested, InputError  as CachedRayCaster does
[[nodiscard]] ChosenMethod plan_run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    CachedRayCaster& caster,
    const std::stop_token& stop);

}  // namespace quasimc

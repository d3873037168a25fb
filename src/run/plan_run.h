#pragma once

#include <stop_token>

#include "light/models/source.h"
#include "planner/planner.h"
#include "quasimc/run_spec.h"
#include "run/cached_ray_caster.h"
#include "scene/scene.h"

namespace quasimc {

/// plan_method() with data from the caster: whether too many surfaces cross for bundles, and what
/// lines across an infinite stand cost under its suns.
/// @throws StopRequested, InputError  like CachedRayCaster
[[nodiscard]] ChosenMethod plan_run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    CachedRayCaster& caster,
    const std::stop_token& stop);

}  // namespace quasimc

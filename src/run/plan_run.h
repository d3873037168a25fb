#pragma once

#include <stop_token>

#include "quasimc/run_spec.h"
#include "quasimc/source.h"
#include "run/cached_ray_caster.h"
#include "samplers/sampler.h"
#include "scene/scene.h"

namespace quasimc {

/// A run whose method is to be chosen.
struct PlanInput {
    const Scene& scene;
    const Sources& sources;
    const RunSpec& spec;
    const Sampler& sampler;
    CachedRayCaster& caster;
    std::stop_token stop = {};
    bool allows_bundles = true;
};

/// The method of the specification or, if that is `automatic`, the one with the least error for
/// equal work in pilot runs: few paths by each method that can be used. Pilot runs count their
/// work, so that the choice is the same on every machine. Runs of few paths, for all or for each
/// triangle, and those with a time limit take the first of candidate_methods() without pilot runs.
/// @throws StopRequested  if a stop was requested
[[nodiscard]] ChosenMethod plan_run(const PlanInput& input);

}  // namespace quasimc

#include "run/plan_run.h"

#include "solvers/direct/sampling_budget.h"
#include "transport/prepared_scene.h"

namespace quasimc {

ChosenMethod plan_run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    CachedRayCaster& caster,
    const std::stop_token& stop) {
    return plan_method(scene, sources, spec, [&] {
        const auto ready = caster.caster_for(scene, spec.accelerator, stop);
        return ready->crossings(stop).gave_up ||
               (scene.cell().periodic() &&
                bundles_trace_suns_alone(
                    {scene, sources, spec.start_area, ready, stop}, spec.paths));
    });
}

}  // namespace quasimc

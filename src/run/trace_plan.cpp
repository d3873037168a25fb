#include "run/trace_plan.h"

namespace quasimc {

RunSpec planned_spec(const RunSpec& spec, const TracePlan& plan) {
    RunSpec planned = spec;
    planned.method = plan.method.value_or(spec.method);
    planned.seed = plan.seed.value_or(spec.seed);
    planned.paths = plan.paths.value_or(spec.paths);
    planned.max_paths = plan.max_paths.value_or(spec.max_paths);
    planned.target_error = plan.target_error.value_or(spec.target_error);
    planned.sampler = plan.sampler.value_or(spec.sampler);
    planned.roulette_threshold = plan.roulette_threshold.value_or(spec.roulette_threshold);
    if (plan.organs_alone) {
        planned.ratios.clear();
        planned.origins.clear();
        planned.sun_shade = SunShade::together;
        planned.groups.clear();
        planned.layers = 0;
        planned.layer_heights.clear();
        planned.target = TargetScope::automatic;
    }
    return planned;
}

}  // namespace quasimc

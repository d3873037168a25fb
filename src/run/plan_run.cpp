#include "run/plan_run.h"

namespace quasimc {

ChosenMethod plan_run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    KeptCaster& caster,
    const std::stop_token& stop) {
    return plan_method(scene, sources, spec, [&] {
        return caster.caster_for(scene, spec.engine, stop)->crossings(stop).gave_up;
    });
}

}  // namespace quasimc

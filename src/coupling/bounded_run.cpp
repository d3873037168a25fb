#include "coupling/bounded_run.h"

#include <algorithm>

#include "run/trace_plan.h"

namespace quasimc {

Result run_bounded(
    Simulator& simulator,
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunControl& control) {
    if (spec.method != Method::automatic || spec.target_error > 0) {
        return simulator.run(scene, sources, spec, control);
    }
    const ChosenMethod chosen =
        SimulatorAccess::state(simulator).plan_without_bundles(scene, sources, spec, control.stop);
    // A path from an organ casts two rays per vertex, one of them to a source; a path from the
    // light casts one.
    const std::uint64_t paths = chosen.method == Method::from_organs
                                    ? std::max<std::uint64_t>(1, spec.paths / 2)
                                    : spec.paths;
    const RunSpec bounded = planned_spec(spec, {.method = chosen.method, .paths = paths});
    Result result = simulator.run(scene, sources, bounded, control);
    if (result.stop != StopReason::no_light) {
        result.chosen = chosen;
    }
    return result;
}

}  // namespace quasimc

#include "coupling/bounded_run.h"

#include <algorithm>

#include "planner/planner.h"

namespace quasimc {

Result run_bounded(
    Simulator& simulator,
    const Scene& scene,
    const Sources& sources,
    RunSpec spec,
    const std::function<void(const Progress&)>& on_progress) {
    if (spec.method != Method::automatic || spec.target_error > 0) {
        return simulator.run(scene, sources, spec, {.on_progress = on_progress});
    }
    const auto refuse_bundles = [] { return true; };
    const ChosenMethod chosen = plan_method(scene, sources, spec, refuse_bundles);
    spec.method = chosen.method;
    // Paths from organs cast two rays where those from the light cast one: to a source, and on.
    if (chosen.method == Method::from_organs) {
        spec.paths = std::max<std::uint64_t>(1, spec.paths / 2);
    }
    Result result = simulator.run(scene, sources, spec, {.on_progress = on_progress});
    if (result.stop != StopReason::no_light) {
        result.chosen = chosen;
    }
    return result;
}

}  // namespace quasimc

#pragma once

#include "quasimc/result.h"
#include "quasimc/run_spec.h"
#include "run/simulator.h"

namespace quasimc {

/// Simulator::run() where the number of paths bounds the work: it takes about as long as so many
/// paths by light_tracing, or less. If the method is `automatic`, it is the best of those for which
/// that holds. ray_bundles are not among them: what they do first takes several times as long,
/// however few the paths are. A run that goes on to a target error chooses among all methods.
[[nodiscard]] Result run_bounded(
    Simulator& simulator,
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunControl& control);

}  // namespace quasimc

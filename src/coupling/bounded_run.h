#pragma once

#include "quasimc/result.h"
#include "quasimc/run_spec.h"
#include "run/simulator.h"

namespace quasimc {

/// Simulator::run() with bounded work: the run takes at most about as long as the same number of
/// paths by light_tracing. `automatic` chooses the best method that satisfies this; ray_bundles
/// does not, as its preparation alone takes several times as long. A run to a target error chooses
/// among all methods.
[[nodiscard]] Result run_bounded(
    Simulator& simulator,
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunControl& control);

}  // namespace quasimc

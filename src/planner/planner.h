#pragma once

#include <functional>
#include <vector>

#include "light/models/source.h"
#include "quasimc/run_spec.h"
#include "scene/scene.h"

namespace quasimc {

/// The methods that may be chosen for a run, most likely the most efficient one first: at least
/// one. It is the choice if there is no time for pilot runs.
/// @param refuse_bundles  whether ray bundles refuse the scene because too many surfaces intersect:
/// called only if they would be among the methods
[[nodiscard]] std::vector<Method> candidate_methods(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<bool()>& refuse_bundles);

/// Whether light of suns or lamps may come by mirrors and narrow lobes.
[[nodiscard]] bool hides_light(const Scene& scene, const Sources& sources);

/// Efficiency of equal shares of paths for the measured organs, relative to the paths that hit each
/// of them: area of all organs over (number of measured organs x their median area). 1 for equal
/// organs that are all measured; infinite if none is.
[[nodiscard]] double gain_of_equal_shares(const Scene& scene);

}  // namespace quasimc

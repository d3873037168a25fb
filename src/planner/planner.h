#pragma once

#include <functional>

#include "light/models/source.h"
#include "quasimc/run_spec.h"
#include "scene/scene.h"

namespace quasimc {

/// plan_method() with a test whether ray bundles refuse the scene because too many surfaces
/// intersect: it is called only if bundles would be chosen.
[[nodiscard]] ChosenMethod plan_method(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<bool()>& refuse_bundles);

/// Efficiency of equal shares of paths for the measured organs, relative to the paths that hit each
/// of them: area of all organs over (number of measured organs x their median area). 1 for equal
/// organs that are all measured; infinite if none is.
[[nodiscard]] double gain_of_equal_shares(const Scene& scene);

/// The largest peak of the scene's lobes, for light along the normal, relative to a white
/// Lambertian surface: albedo (mean over the bands) times peak_brightness(). Infinite for narrow
/// lobes and mirrors, 0 if nothing scatters; without sensors.
[[nodiscard]] double brightest_peak(const Scene& scene);

}  // namespace quasimc

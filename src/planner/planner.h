#pragma once

#include <functional>

#include "light/models/source.h"
#include "quasimc/run_spec.h"
#include "scene/scene.h"

namespace quasimc {

/// plan_method() where it can be told whether so many surfaces cross each other that ray bundles
/// refuse the scene: it is asked only if bundles would be chosen.
[[nodiscard]] ChosenMethod plan_method(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<bool()>& refuse_bundles);

/// How much the errors of the measured organs would gain if every one of them got as many paths,
/// instead of each as many as light finds it by: area of all organs over (number of measured organs
/// x their median area). 1 for equal organs that are all measured; infinite if none is.
[[nodiscard]] double gain_of_equal_shares(const Scene& scene);

/// The brightest of the scene's lobes at its peak, light arriving straight on, relative to a white
/// surface of the cosine law: its albedo (mean over the bands) times its sharpness. Infinite with a
/// mirror, 0 if nothing scatters; sensors that light passes don't count.
[[nodiscard]] double brightest_peak(const Scene& scene);

}  // namespace quasimc

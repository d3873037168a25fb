#pragma once

#include "quasimc/run_spec.h"
#include "scene/scene.h"
#include "sources/source.h"

namespace quasimc {

/// How much the errors of the measured organs would gain if every one of them got as many paths,
/// instead of each as many as light finds it by: area of all organs over (number of measured organs
/// x their median area). 1 for equal organs that are all measured; infinite if none is.
[[nodiscard]] double gain_of_equal_shares(const Scene& scene);

/// The brightest of the scene's lobes at its peak, light arriving straight on, relative to a white
/// surface of the cosine law: its albedo (mean over the bands) times its sharpness. Infinite with a
/// mirror, 0 if nothing scatters; sensors that light passes don't count.
[[nodiscard]] double brightest_peak(const Scene& scene);

}  // namespace quasimc

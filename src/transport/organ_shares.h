#pragma once

#include "scene/scene.h"

namespace quasimc {

/// Median area of the measured organs; 0 if there are none.
[[nodiscard]] double median_measured_area(const Scene& scene);

/// Approximate mean projected area of the scene: the area of its cell, or a quarter of the surface
/// of its box (Cauchy's formula).
[[nodiscard]] double seen_area(const Scene& scene);

/// The peak_brightness() from which on a lobe counts as narrow in from_organs, which then samples
/// light of suns and lamps through it by light subpaths. At this limit light subpaths hit a typical
/// organ as often as samples from it hit a lit lobe; at least kNarrowPeak. Delta lobes are always
/// narrow.
[[nodiscard]] double followed_peak(const Scene& scene);

}  // namespace quasimc

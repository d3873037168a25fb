#pragma once

#include "scene/scene.h"

namespace quasimc {

/// The middle one of the areas of the organs that are measured; 0 if none is.
[[nodiscard]] double median_measured_area(const Scene& scene);

/// About the area that the scene shows to light from far away: that of its cell, or a quarter of
/// the surface of its box (Cauchy).
[[nodiscard]] double seen_area(const Scene& scene);

/// The peak_brightness() of lobes from which on from_organs follows the light of suns and lamps
/// from its source: where paths from there find a typical organ as often as looks from it find a
/// lobe lit, and kSharpPeak at least. Lobes of one direction are always as sharp.
[[nodiscard]] double followed_peak(const Scene& scene);

}  // namespace quasimc

#pragma once

#include <cstddef>

#include "light/models/source.h"
#include "picture/image.h"

namespace quasimc {

/// A sky as seen from below: north at the top, east at the left, the zenith in the centre,
/// equidistant in elevation. Colours run from dark blue (black sky) to white (its brightest point)
/// with the square root of radiance; rings are at 0, 30 and 60 degrees; a sun above the horizon is
/// a ring with a dot. Needs has_png(). World: x east, y north, z up.
/// @param to_sun  unit
/// @param size    pixels along a side, 64 to 4096
[[nodiscard]] Image plot_sky(const Source& sky, const Vec3& to_sun, std::size_t size);

}  // namespace quasimc

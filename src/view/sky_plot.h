#pragma once

#include <optional>

#include "base/vec3.h"
#include "sources/source.h"
#include "view/picture.h"

namespace quasimc {

/// A sky as a person sees it who lies on the back, head to the north: north above, east at the
/// left, the zenith in the middle, equal steps of elevation equally far apart. Colours run from
/// dark blue (black sky) to white (its brightest place) with the square root of radiance; rings are
/// at 0, 30 and 60 degrees; the sun, if given, is a ring with a dot.
/// @param north  horizontal, world with z up
/// @param size   pixels of a side, 64 or more
[[nodiscard]] Picture plot_sky(
    const Source& sky, const Vec3& north, const std::optional<Vec3>& to_sun, std::size_t size);

}  // namespace quasimc

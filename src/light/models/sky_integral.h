#pragma once

#include "base/vec3.h"
#include "quasimc/source.h"

namespace quasimc {

/// Integrals over the upper hemisphere of the radiance L of a shape: of L |d.x|, L |d.y| and
/// L d.z, to a relative 1e-7. The last is the irradiance on the horizontal; and through a box of
/// faces A comes their sum weighted by A.
[[nodiscard]] Vec3 projected_radiance(const SkyShape& shape);

}  // namespace quasimc

#pragma once

#include "base/vec3.h"
#include "quasimc/source.h"

namespace quasimc {

/// Integrals over the upper hemisphere of the radiance L of a shape: of L |d.x|, L |d.y| and L d.z,
/// with a relative error of 1e-7. The last is the irradiance on the horizontal; their sum weighted
/// by the face areas of a box is the flux into the box.
[[nodiscard]] Vec3 projected_radiance(const SkyShape& shape);

}  // namespace quasimc

#pragma once

#include "raster/scene_projection.h"

namespace quasimc {

/// The point where light that travels along `direction` enters the box around a scene, uniform over
/// the faces turned towards it, as projected along it. The mean over the unit square corresponds to
/// the light through box.projected_area(direction).
[[nodiscard]] Vec3 entry_point(const EntryBox& box, const Vec3& direction, double u0, double u1);

}  // namespace quasimc

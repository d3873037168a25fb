#pragma once

#include "geometry/cast/intersector.h"
#include "geometry/mesh/local_mesh.h"

namespace quasimc {

/// Where `ray` meets the triangle of `hit`, which was found: the same, or of slivers looked for
/// again in double precision. What the ray passes just beside, within the engine's rounding, it
/// meets on the border.
[[nodiscard]] Hit snapped_to_sliver(const LocalMesh& mesh, const Ray& ray, const Hit& hit);

}  // namespace quasimc

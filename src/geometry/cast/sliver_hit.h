#pragma once

#include "geometry/cast/intersector.h"
#include "geometry/mesh/local_mesh.h"

namespace quasimc {

/// Returns `hit`, recomputed in double precision on slivers. A ray that misses a sliver by less
/// than the intersector's rounding hits its border.
[[nodiscard]] Hit snapped_to_sliver(const LocalMesh& mesh, const Ray& ray, const Hit& hit);

}  // namespace quasimc

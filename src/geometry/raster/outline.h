#pragma once

#include <vector>

#include "base/vec3.h"
#include "geometry/mesh/local_mesh.h"

namespace quasimc {

/// The vertices that may be corners of the mesh's convex hull: all but those that certainly are
/// not. Of a large mesh few remain.
[[nodiscard]] std::vector<Vec3> outline_points(const LocalMesh& mesh);

}  // namespace quasimc

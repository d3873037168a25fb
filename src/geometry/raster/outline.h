#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "geometry/mesh/local_mesh.h"

namespace quasimc {

/// The vertices that may be corners of the mesh's convex hull: all but those that certainly are
/// not. Of a large mesh few remain.
[[nodiscard]] std::vector<Vec3> outline_points(const LocalMesh& mesh);

/// The same of a set of points, in their order.
/// @param cells  how finely to look: about the number of corners of the triangles
[[nodiscard]] std::vector<Vec3> outline_points(std::span<const Vec3> points, std::size_t cells);

}  // namespace quasimc

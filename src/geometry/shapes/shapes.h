#pragma once

#include <span>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

/// The triangles of make_polygon() as numbers of the corners.
[[nodiscard]] std::vector<Face> make_polygon_faces(std::span<const Vec3> corners);

}  // namespace quasimc

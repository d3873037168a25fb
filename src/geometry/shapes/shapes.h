#pragma once

#include <span>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

/// A polygon cut into triangles, as indices of its corners.
struct CutPolygon {
    std::vector<Face> faces;
    bool sides_cross = false;
};

/// Triangulates a polygon, convex or not, by ear clipping. A self-intersecting one has no inside;
/// it becomes the fan from its first corner, as in most programs.
[[nodiscard]] CutPolygon cut_polygon(std::span<const Vec3> corners);

}  // namespace quasimc

#pragma once

#include <span>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

/// A polygon cut into triangles, as numbers of its corners.
struct CutPolygon {
    std::vector<Face> faces;
    bool sides_cross = false;
};

/// Cuts a polygon, convex or not, by clipping ears. One whose sides cross has no inside; it becomes
/// the fan from its first corner, which is what most programs draw.
[[nodiscard]] CutPolygon cut_polygon(std::span<const Vec3> corners);

}  // namespace quasimc

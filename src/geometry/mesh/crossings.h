#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "geometry/mesh/local_mesh.h"
#include "geometry/mesh/point2.h"

namespace quasimc {

/// Segment on a triangle where another one crosses or touches it, in barycentric coordinates u and
/// v.
struct SurfaceCrossing {
    std::uint32_t triangle = 0, other = 0;
    Point2 from, to;
};

/// The crossings in a mesh.
struct SurfaceCrossings {
    std::vector<SurfaceCrossing> found;  ///< sorted by triangle
    bool gave_up = false;  ///< too many triangles cross, or their boxes overlap: `found` is empty
};

/// Upper limit of compared pairs of triangles with overlapping boxes.
[[nodiscard]] std::size_t most_compared_for_crossings(std::size_t triangles);
/// Upper limit of crossings: each increases the time for cutting triangles.
[[nodiscard]] std::size_t most_crossings(std::size_t triangles);

/// Finds where triangles of a mesh cross each other, or end on each other, inside their borders:
/// triangles that share a side do not, nor do coplanar ones. Takes some n log n comparisons where
/// few boxes of triangles overlap.
/// @throws StopRequested  if a stop was requested
[[nodiscard]] SurfaceCrossings find_crossings(
    const LocalMesh& mesh, const std::stop_token& stop = {});

}  // namespace quasimc

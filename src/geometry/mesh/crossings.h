#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "geometry/mesh/local_mesh.h"
#include "geometry/mesh/point2.h"

namespace quasimc {

/// Where another triangle crosses or touches a triangle: a part of a straight line on it, in its
/// barycentric coordinates u and v.
struct SurfaceCrossing {
    std::uint32_t triangle = 0, other = 0;
    Point2 from, to;
};

/// What crosses in a mesh.
struct SurfaceCrossings {
    std::vector<SurfaceCrossing> found;  ///< in the order of the triangles
    bool gave_up = false;  ///< too many triangles cross, or their boxes overlap: nothing is told
};

/// Triangles whose boxes overlap are compared, up to so many pairs.
[[nodiscard]] std::size_t most_compared_for_crossings(std::size_t triangles);
/// So many crossings are found at most: what they cut triangles into takes time with each.
[[nodiscard]] std::size_t most_crossings(std::size_t triangles);

/// Where triangles of a mesh cross each other, or end on each other, within their borders: two that
/// share a side do not. Those that lie in one plane don't cross. Takes some n log n comparisons
/// where the boxes of triangles overlap few others.
/// @throws StopRequested  if a stop was requested
[[nodiscard]] SurfaceCrossings find_crossings(
    const LocalMesh& mesh, const std::stop_token& stop = {});

}  // namespace quasimc

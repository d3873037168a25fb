#pragma once

#include <algorithm>

#include "base/vec3.h"

namespace quasimc {

/// Whether single precision blurs the hit of a ray on a triangle by more than some 2^-20 along it,
/// local coordinates. The products of edges in its computation are rounded by 2^-24 of the square
/// of the longest edge, and divided by the area.
/// @param edge1, edge2  from the first corner to the others
inline bool is_sliver(const Vec3& edge1, const Vec3& edge2) {
    constexpr double kMost = 64;
    const Vec3 edge3 = edge2 - edge1;
    const double longest = std::max({dot(edge1, edge1), dot(edge2, edge2), dot(edge3, edge3)});
    const Vec3 across = cross(edge1, edge2);
    return longest * longest * longest > kMost * kMost * dot(across, across);
}

}  // namespace quasimc

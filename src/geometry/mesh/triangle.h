#pragma once

#include <array>
#include <vector>

#include "base/bounds.h"
#include "base/vec3.h"

namespace quasimc {

/// Three corners in the scene's units. The upper side is the one from which they run
/// counter-clockwise.
using Triangle = std::array<Vec3, 3>;

/// Twice the area times the unit normal of the upper side.
constexpr Vec3 area_vector(const Triangle& t) {
    return cross(t[1] - t[0], t[2] - t[0]);
}

inline Bounds bounds_of(const Triangle& t) {
    Bounds bounds;
    for (const Vec3& corner : t) {
        bounds.add(corner);
    }
    return bounds;
}

inline double area(const Triangle& t) {
    return 0.5 * length(area_vector(t));
}

inline double area(const std::vector<Triangle>& triangles) {
    double sum = 0;
    for (const Triangle& t : triangles) {
        sum += area(t);
    }
    return sum;
}

}  // namespace quasimc

#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "quasimc/mesh.h"

namespace quasimc {

/// The mirror image of direction `d` at a plane with unit normal `n`.
constexpr Vec3 reflected(const Vec3& d, const Vec3& n) {
    return d - (2 * dot(d, n)) * n;
}

/// A frame about `n`, continuous except at one point (Duff et al. 2017, JCGT 6(1)).
inline Frame frame_about(const Vec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

inline std::array<Vec3, 8> corners_of(const Bounds& box) {
    std::array<Vec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i] = {
            (i & 1U) != 0 ? box.high.x : box.low.x, (i & 2U) != 0 ? box.high.y : box.low.y,
            (i & 4U) != 0 ? box.high.z : box.low.z};
    }
    return corners;
}

}  // namespace quasimc

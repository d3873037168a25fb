#pragma once

#include <array>

#include "base/vec3.h"

namespace quasimc {

/// p -> linear * p + shift.
struct Affine {
    std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 shift;

    [[nodiscard]] constexpr Vec3 vector(const Vec3& v) const {
        return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    }
    [[nodiscard]] constexpr Vec3 point(const Vec3& p) const { return vector(p) + shift; }
};

}  // namespace quasimc

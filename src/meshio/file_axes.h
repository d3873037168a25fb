#pragma once

#include "quasimc/mesh.h"

namespace quasimc {

/// The composition of two transforms, `first` applied first.
[[nodiscard]] constexpr Affine after(const Affine& second, const Affine& first) {
    Affine both;
    const auto& [a, b, c] = first.rows;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& row = second.rows[i];
        both.rows[i] = row.x * a + row.y * b + row.z * c;
    }
    both.shift = second.point(first.shift);
    return both;
}

/// The factor by which a transform multiplies volumes: less than 0 if it makes mirror images.
[[nodiscard]] constexpr double determinant(const Affine& transform) {
    return dot(transform.rows[0], cross(transform.rows[1], transform.rows[2]));
}

/// From the axes and the unit of a file whose y axis points up to those of a scene: x stays x.
/// @param scale  units of the scene in one of the file
[[nodiscard]] constexpr Affine from_y_up(UpAxis up, double scale) {
    return up == UpAxis::y ? Affine{{Vec3{scale, 0, 0}, Vec3{0, scale, 0}, Vec3{0, 0, scale}}, {}}
                           : Affine{{Vec3{scale, 0, 0}, Vec3{0, 0, -scale}, Vec3{0, scale, 0}}, {}};
}

/// The inverse of from_y_up().
[[nodiscard]] constexpr Affine to_y_up(UpAxis up, double scale) {
    return up == UpAxis::y ? from_y_up(up, scale)
                           : Affine{{Vec3{scale, 0, 0}, Vec3{0, 0, scale}, Vec3{0, -scale, 0}}, {}};
}

}  // namespace quasimc

#pragma once

#include <cmath>
#include <numbers>

#include "quasimc/vec3.h"

namespace quasimc {

/// The transform that does `second` after `first`.
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

/// The turn by an angle in degrees about an axis of length 1, counter-clockwise as seen from where
/// it points (Rodrigues).
[[nodiscard]] inline Affine rotation_about(const Vec3& k, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const double c = std::cos(angle), s = std::sin(angle);
    const Vec3 kc = (1 - c) * k;
    return {
        {Vec3{c + kc.x * k.x, kc.x * k.y - s * k.z, kc.x * k.z + s * k.y},
         Vec3{kc.y * k.x + s * k.z, c + kc.y * k.y, kc.y * k.z - s * k.x},
         Vec3{kc.z * k.x - s * k.y, kc.z * k.y + s * k.x, c + kc.z * k.z}},
        {}};
}

/// A turn about x by `roll`, then about y by `elevation`, then about z by `azimuth`, degrees.
[[nodiscard]] inline Affine euler_rotation(double azimuth, double elevation, double roll) {
    return after(
        after(rotation_about({0, 0, 1}, azimuth), rotation_about({0, 1, 0}, elevation)),
        rotation_about({1, 0, 0}, roll));
}

/// From the axes and the unit of a file whose y axis points up to those of a scene: x stays x.
/// @param scale  units of the scene in one of the file
[[nodiscard]] constexpr Affine from_y_up(UpAxis up, double scale) {
    return up == UpAxis::y ? Affine{{Vec3{scale, 0, 0}, Vec3{0, scale, 0}, Vec3{0, 0, scale}}, {}}
                           : Affine{{Vec3{scale, 0, 0}, Vec3{0, 0, -scale}, Vec3{0, scale, 0}}, {}};
}

/// The way back.
[[nodiscard]] constexpr Affine to_y_up(UpAxis up, double scale) {
    return up == UpAxis::y ? from_y_up(up, scale)
                           : Affine{{Vec3{scale, 0, 0}, Vec3{0, 0, scale}, Vec3{0, -scale, 0}}, {}};
}

}  // namespace quasimc

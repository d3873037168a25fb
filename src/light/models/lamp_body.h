#pragma once

#include "base/vec3.h"
#include "quasimc/source.h"

namespace quasimc {

/// The opening of a lamp: points on it, and samples of it from a point of the scene.
struct LampBody {
    Vec3 center;
    Frame axes;
    Opening opening;

    /// A point of the opening, uniform over its length or area, and the axes of its pattern.
    struct SurfacePoint {
        Vec3 position;
        Frame axes;
    };
    [[nodiscard]] SurfacePoint draw_point(double u0, double u1) const;

    /// A point of the opening that is sampled from a point of the scene.
    struct LampSample {
        Vec3 to_light;  ///< unit
        double distance = 0;
        Frame axes;         ///< of the pattern there
        double factor = 0;  ///< irradiance facing the point per intensity towards it, over the
                            ///< density; 0: not visible
    };
    /// Samples the opening from `point`: rectangles and spheres uniformly in solid angle, lines
    /// uniformly in the angle at the point (their irradiance is bounded at any distance), disks by
    /// area.
    [[nodiscard]] LampSample seen_from(const Vec3& point, double u0, double u1) const;
    /// Samples a rectangle by area.
    [[nodiscard]] LampSample seen_by_area(const Vec3& point, double u0, double u1) const;

    /// Radius of the sphere about the centre that contains the opening.
    [[nodiscard]] double radius() const;
};

/// The vector with components x, y, z along the axes, and back.
[[nodiscard]] inline Vec3 from_axes(const Frame& f, const Vec3& v) {
    return v.x * f.s + v.y * f.t + v.z * f.n;
}
[[nodiscard]] inline Vec3 to_axes(const Frame& f, const Vec3& v) {
    return {dot(v, f.s), dot(v, f.t), dot(v, f.n)};
}

/// The unit vector at angle theta to `axis`, where t = (1 - cos theta) / 2, and azimuth 2 pi u.
[[nodiscard]] Vec3 direction_in_cone(const Vec3& axis, double t, double u);

/// (1 - cos a) / 2 for the half-angle a under which a sphere is seen from `distance` > `radius`.
[[nodiscard]] double cone_of_sphere(double radius, double distance);

}  // namespace quasimc

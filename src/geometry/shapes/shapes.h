#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "geometry/mesh/triangle.h"

namespace quasimc {

/// Control points of a bicubic Bezier patch: points[4 * i + j] is P_ij of the surface
/// S(u, v) = sum over i, j of B_i(u) B_j(v) P_ij. The upper side is that of dS/du x dS/dv.
using BezierPatch = std::array<Vec3, 16>;

/// How closely curved shapes are followed.
struct Flatness {
    /// Largest distance of the triangles from the true surface, as a fraction of the shape's size
    /// (the diagonal of its bounds).
    double tolerance = 1e-3;
};

// Each function returns the triangles of a shape in the scene's units. Shapes of no area give
// triangles of no area; the scene builder reports them.

/// a, b, c counter-clockwise seen from the upper side.
[[nodiscard]] std::vector<Triangle> make_triangle(const Vec3& a, const Vec3& b, const Vec3& c);
/// Corners p, p + a, p + a + b, p + b; the upper side is that of a x b.
[[nodiscard]] std::vector<Triangle> make_parallelogram(const Vec3& p, const Vec3& a, const Vec3& b);
/// A leaf-like rhombus: `length_vector` from `base` to the tip is one diagonal, the other is
/// `width` long. `up` points away from the upper side; the part of it across the length counts.
[[nodiscard]] std::vector<Triangle> make_rhombus(
    const Vec3& base, const Vec3& length_vector, const Vec3& up, double width);
/// A simple polygon (convex or not) by ear clipping; at least three corners, counter-clockwise seen
/// from the upper side. Corners may lie on a straight side, repeat their neighbour, or be not quite
/// in one plane. Throws InputError if sides cross each other so that no triangles can be cut off.
[[nodiscard]] std::vector<Triangle> make_polygon(std::span<const Vec3> corners);
/// The same as numbers of the corners.
[[nodiscard]] std::vector<Face> make_polygon_faces(std::span<const Vec3> corners);
/// A surface of one or several patches, tessellated on the surface itself, without cracks inside a
/// patch and along sides that patches share (the same four control points). At most 1024 steps
/// along each side of a patch, whatever the tolerance.
[[nodiscard]] std::vector<Triangle> make_bezier_surface(
    std::span<const BezierPatch> patches, Flatness flatness);
/// An internode: the side of a cylinder, or of a cone when the radii differ, from `base` along
/// `axis`, upper side outward. It has `sides` >= 3 flat sides, a little outside the round one, so
/// that their area is that of the round side. `capped` closes both ends.
[[nodiscard]] std::vector<Triangle> make_cylinder(
    const Vec3& base,
    const Vec3& axis,
    double radius_base,
    double radius_top,
    int sides,
    bool capped);
/// A disk, upper side `normal`, with `sides` >= 3 corners and the area of the true disk.
[[nodiscard]] std::vector<Triangle> make_disk(
    const Vec3& center, const Vec3& normal, double radius, int sides);
/// A sphere, upper side outward: an icosahedron whose triangles are cut into four `levels` times (0
/// to 11), a little outside the true sphere, so that the area is that of the sphere.
[[nodiscard]] std::vector<Triangle> make_sphere(const Vec3& center, double radius, int levels);

}  // namespace quasimc

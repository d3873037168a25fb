#pragma once

// Triangles, meshes, shapes made of triangles, and the cell that a scene may repeat.

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "quasimc/vec3.h"

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

/// The numbers of a triangle's three vertices, in the order of its corners.
using Face = std::array<std::uint32_t, 3>;

/// Triangles that may share vertices. Triangles without neighbours are a mesh too.
struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Face> faces;  ///< every number is less than the number of vertices

    Mesh() = default;
    Mesh(std::vector<Vec3> all_vertices, std::vector<Face> all_faces);
    /// The same triangles in the same order, as by push_back().
    Mesh(const std::vector<Triangle>& triangles);  // NOLINT(google-explicit-constructor)
    Mesh(std::initializer_list<Triangle> triangles);

    [[nodiscard]] std::size_t size() const { return faces.size(); }
    [[nodiscard]] bool empty() const { return faces.empty(); }
    /// The corners of triangle `i`.
    [[nodiscard]] Triangle operator[](std::size_t i) const {
        const Face& f = faces[i];
        return {vertices[f[0]], vertices[f[1]], vertices[f[2]]};
    }
    /// Adds a triangle. Corners with all the digits of a corner of the triangle before are not
    /// stored again.
    void push_back(const Triangle& triangle);
    /// Adds the triangles of another mesh; their vertices are stored again.
    void append(const Mesh& other);

    friend bool operator==(const Mesh&, const Mesh&) = default;
};

[[nodiscard]] double area(const Mesh& mesh);

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
/// in one plane. Throws InputError if sides cross each other.
[[nodiscard]] std::vector<Triangle> make_polygon(std::span<const Vec3> corners);
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

/// The horizontal rectangle that is repeated without end along x, y or both. World coordinates.
struct Cell {
    bool along_x = false, along_y = false;
    double low_x = 0, low_y = 0;    ///< used along periodic axes only
    double size_x = 1, size_y = 1;  ///< the periods, > 0

    [[nodiscard]] bool periodic() const { return along_x || along_y; }
    friend bool operator==(const Cell&, const Cell&) = default;
};

/// What finds the triangles that rays hit.
enum class Engine {
    embree,
    brute_force,  ///< tries every triangle: slow, to check the other
};

/// The cross-section of a beam in which its rays start.
enum class CrossSectionShape {
    silhouette,  ///< the convex hull of the scene seen along the beam: the fewest rays that miss
    sphere,      ///< the disc across the bounding sphere, as in Cieslak et al. (2008)
};

}  // namespace quasimc

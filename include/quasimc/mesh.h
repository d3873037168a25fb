#pragma once

// Points and directions, boxes, transforms, the axes of files; triangles, meshes, shapes made of
// triangles, and the cell that a scene may repeat.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace quasimc {

/// A vector or point in space; the unit of length is the scene's.
struct Vec3 {
    double x = 0, y = 0, z = 0;

    constexpr Vec3& operator+=(const Vec3& b) { return x += b.x, y += b.y, z += b.z, *this; }
    constexpr Vec3& operator-=(const Vec3& b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
    constexpr Vec3& operator*=(double s) { return x *= s, y *= s, z *= s, *this; }
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(Vec3 a, const Vec3& b) {
    return a += b;
}
constexpr Vec3 operator-(Vec3 a, const Vec3& b) {
    return a -= b;
}
constexpr Vec3 operator-(const Vec3& a) {
    return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(Vec3 a, double s) {
    return a *= s;
}
constexpr Vec3 operator*(double s, Vec3 a) {
    return a *= s;
}
constexpr Vec3 operator/(const Vec3& a, double s) {
    return {a.x / s, a.y / s, a.z / s};
}

constexpr double dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(const Vec3& a) {
    return std::sqrt(dot(a, a));
}

/// `a` scaled to length 1; `a` must not be zero.
inline Vec3 normalized(const Vec3& a) {
    return a / length(a);
}

inline bool is_finite(const Vec3& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Two unit vectors that complete the unit vector `n` to a right-handed frame (s, t, n).
struct Frame {
    Vec3 s, t, n;
};

/// A side of a surface. Seen from the upper side, the corners of its triangles run
/// counter-clockwise.
enum class SurfaceSide : std::uint8_t { upper, lower };

inline constexpr std::array<SurfaceSide, 2> kSurfaceSides{SurfaceSide::upper, SurfaceSide::lower};

/// 0 for the upper side, 1 for the lower.
[[nodiscard]] constexpr std::size_t index_of(SurfaceSide side) {
    return static_cast<std::size_t>(side);
}

[[nodiscard]] constexpr SurfaceSide opposite(SurfaceSide side) {
    return side == SurfaceSide::upper ? SurfaceSide::lower : SurfaceSide::upper;
}

/// The side that light along a direction meets.
/// @param along  dot(normal of the upper side, direction)
[[nodiscard]] constexpr SurfaceSide side_facing(double along) {
    return along < 0 ? SurfaceSide::upper : SurfaceSide::lower;
}

/// An axis-parallel box; empty until a point is added.
struct Bounds {
    Vec3 low{kInfinity, kInfinity, kInfinity};
    Vec3 high{-kInfinity, -kInfinity, -kInfinity};

    void add(const Vec3& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    void include(const Bounds& other) {
        if (!other.empty()) {
            add(other.low);
            add(other.high);
        }
    }
    [[nodiscard]] bool empty() const { return low.x > high.x; }
    [[nodiscard]] Vec3 center() const { return 0.5 * (low + high); }
    [[nodiscard]] Vec3 size() const { return high - low; }
    /// Half the diagonal: the radius of the sphere about the center that holds the box.
    [[nodiscard]] double radius() const { return 0.5 * length(size()); }

  private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
};

/// p -> linear * p + shift.
struct Affine {
    std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 shift;

    [[nodiscard]] constexpr Vec3 vector(const Vec3& v) const {
        return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    }
    [[nodiscard]] constexpr Vec3 point(const Vec3& p) const { return vector(p) + shift; }
};

enum class UpAxis { z, y };

/// The orientation of a file's axes in the world. Inside the program z is up, and north is given by
/// the file: axes are permuted, never rotated. Both frames are right-handed; lengths are kept.
class Orientation {
  public:
    Orientation() = default;
    /// @param north  horizontal direction in the file's axes (0 up component), not zero
    Orientation(UpAxis up, const Vec3& north) : up_(up), north_(north) {}

    [[nodiscard]] UpAxis up() const { return up_; }
    [[nodiscard]] const Vec3& north() const { return north_; }

    /// From the file's axes to z up. Axes are permuted, never rotated: no digit is lost.
    [[nodiscard]] Vec3 inward(const Vec3& p) const {
        return up_ == UpAxis::z ? p : Vec3{p.z, p.x, p.y};
    }
    [[nodiscard]] Vec3 outward(const Vec3& p) const {
        return up_ == UpAxis::z ? p : Vec3{p.y, p.z, p.x};
    }

    /// Unit vector towards a point of the sky, z up. Azimuth clockwise from north as seen from
    /// above.
    [[nodiscard]] Vec3 towards(double azimuth_deg, double elevation_deg) const {
        const double radians = std::numbers::pi / 180;
        const double around = azimuth_deg * radians;
        const Vec3 n = normalized(inward(north_));
        const Vec3 east{n.y, -n.x, 0};
        const double high = elevation_deg * radians;
        const Vec3 flat = std::cos(around) * n + std::sin(around) * east;
        return std::cos(high) * flat + Vec3{0, 0, std::sin(high)};
    }

  private:
    UpAxis up_ = UpAxis::z;
    Vec3 north_{0, 1, 0};
};

/// Three corners in the scene's units, counter-clockwise as seen from the upper side.
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

/// The indices of a triangle's three vertices, in the order of its corners.
using Face = std::array<std::uint32_t, 3>;

/// Triangles that may share vertices. They need not be connected.
struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Face> faces;  ///< every number is less than the number of vertices

    Mesh() = default;
    Mesh(std::vector<Vec3> all_vertices, std::vector<Face> all_faces);
    /// Adds the triangles in their order, as push_back() does.
    Mesh(const std::vector<Triangle>& triangles);  // NOLINT(google-explicit-constructor)
    Mesh(std::initializer_list<Triangle> triangles);

    [[nodiscard]] std::size_t size() const { return faces.size(); }
    [[nodiscard]] bool empty() const { return faces.empty(); }
    /// The corners of triangle `i`.
    [[nodiscard]] Triangle operator[](std::size_t i) const {
        const Face& f = faces[i];
        return {vertices[f[0]], vertices[f[1]], vertices[f[2]]};
    }
    /// Adds a triangle. Corners that equal a corner of the previous triangle exactly are not stored
    /// again.
    void push_back(const Triangle& triangle);
    /// Adds the triangles of another mesh; their vertices are stored again.
    void append(const Mesh& other);

    friend bool operator==(const Mesh&, const Mesh&) = default;
};

[[nodiscard]] double area(const Mesh& mesh);

/// Control points of a bicubic Bezier patch: points[4 * i + j] is P_ij of the surface
/// S(u, v) = sum over i, j of B_i(u) B_j(v) P_ij. The upper side is that of dS/du x dS/dv.
using BezierPatch = std::array<Vec3, 16>;

/// The accuracy of curved shapes.
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
/// `width` long. `up` points away from the upper side; only its component across the length counts.
[[nodiscard]] std::vector<Triangle> make_rhombus(
    const Vec3& base, const Vec3& length_vector, const Vec3& up, double width);
/// A simple polygon (convex or not) by ear clipping; at least three corners, counter-clockwise seen
/// from the upper side. Corners may lie on a straight side, repeat their neighbour, or be
/// approximately in one plane. Throws InputError if sides cross each other.
[[nodiscard]] std::vector<Triangle> make_polygon(std::span<const Vec3> corners);
/// A surface of one or several patches, tessellated on the surface itself, without cracks inside a
/// patch and along sides that patches share (the same four control points). At most 1024 steps
/// along each side of a patch, for any tolerance.
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

/// The horizontal rectangle that repeats periodically along x, y or both. World coordinates.
struct Cell {
    bool along_x = false, along_y = false;
    double low_x = 0, low_y = 0;    ///< only for periodic axes
    double size_x = 1, size_y = 1;  ///< the periods, > 0

    [[nodiscard]] bool periodic() const { return along_x || along_y; }
    friend bool operator==(const Cell&, const Cell&) = default;
};

/// The data structure that finds the triangles that rays hit.
enum class Accelerator {
    embree,
    brute_force,  ///< tests every triangle: slow, for verification
};

/// The cross-section of a beam in which its rays start.
enum class StartArea {
    silhouette,  ///< the convex hull of the scene's projection along the beam: the fewest rays that
                 ///< miss
    bounding_sphere,  ///< the disc across the bounding sphere, as in Cieslak et al. (2008)
};

}  // namespace quasimc

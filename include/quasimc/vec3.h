#pragma once

// Points and directions, boxes, transforms, the sides of surfaces, and the axes of files.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

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

/// A side of a surface: the upper one is that from which the corners of its triangles run
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

/// The side that light meets which travels along a direction.
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

/// How the axes of a file lie in the world. Inside the program z is up, and north is where the file
/// says: axes are permuted, never turned. Both frames are right-handed; lengths are kept.
class Orientation {
  public:
    Orientation() = default;
    /// @param north  horizontal direction in the file's axes (0 up component), not zero
    Orientation(UpAxis up, const Vec3& north) : up_(up), north_(north) {}

    [[nodiscard]] UpAxis up() const { return up_; }
    [[nodiscard]] const Vec3& north() const { return north_; }

    /// From the file's axes to z up. Axes are permuted, never turned: no digit is lost.
    [[nodiscard]] Vec3 inward(const Vec3& p) const {
        return up_ == UpAxis::z ? p : Vec3{p.z, p.x, p.y};
    }
    [[nodiscard]] Vec3 outward(const Vec3& p) const {
        return up_ == UpAxis::z ? p : Vec3{p.y, p.z, p.x};
    }

    /// Unit vector towards a place of the sky, z up. Azimuth clockwise from north as seen from
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

}  // namespace quasimc

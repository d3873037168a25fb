#include "geometry/shapes/shapes.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/angles.h"
#include "base/checks.h"
#include "base/vec3.h"

namespace quasimc {

namespace {

/// `v` scaled to length 1, or the zero vector.
Vec3 direction_or_zero(const Vec3& v) {
    const double l = length(v);
    return l > 0 ? v / l : Vec3{};
}

/// A frame about `axis`, or the world's when the axis has no length.
Frame frame_along(const Vec3& axis) {
    const double l = length(axis);
    return l > 0 ? frame_about(axis / l) : Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}

/// Corners of a regular polygon, counter-clockwise about `frame.n`.
std::vector<Vec3> make_ring(const Vec3& center, const Frame& frame, double radius, int sides) {
    std::vector<Vec3> ring;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * kPi * i / sides;
        ring.push_back(
            center + radius * std::cos(angle) * frame.s + radius * std::sin(angle) * frame.t);
    }
    return ring;
}

/// Adds the convex polygon `ring`; its upper side is that on which it runs counter-clockwise.
void add_fan(std::vector<Triangle>& triangles, const std::vector<Vec3>& ring) {
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        triangles.push_back({ring[0], ring[i], ring[i + 1]});
    }
}

/// Factor on the radius of a cone's corners that preserves the area of its side.
///
/// With n corners at k times the radius, the side has n equal trapeziums of area
/// k sin(pi/n) (r0 + r1) sqrt(h^2 + k^2 cos^2(pi/n) (r0 - r1)^2); their sum is to be
/// pi (r0 + r1) sqrt(h^2 + (r0 - r1)^2): a quadratic equation for k^2.
double cone_growth(double height, double radius_difference, int sides) {
    const double h2 = height * height, d2 = radius_difference * radius_difference;
    if (!(h2 + d2 > 0)) {
        return 1;
    }
    const double s = sides * std::sin(kPi / sides) / kPi, c = std::cos(kPi / sides);
    const double s2 = s * s, c2 = c * c;
    const double root = std::sqrt(s2 * s2 * h2 * h2 + 4 * s2 * c2 * d2 * (h2 + d2));
    return std::sqrt(2 * (h2 + d2) / (s2 * h2 + root));
}

}  // namespace

std::vector<Triangle> make_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {{a, b, c}};
}

std::vector<Triangle> make_parallelogram(const Vec3& p, const Vec3& a, const Vec3& b) {
    return {{p, p + a, p + a + b}, {p, p + a + b, p + b}};
}

std::vector<Triangle> make_rhombus(
    const Vec3& base, const Vec3& length_vector, const Vec3& up, double width) {
    const Vec3 to_right = (0.5 * width) * direction_or_zero(cross(length_vector, up));
    const Vec3 middle = base + 0.5 * length_vector, tip = base + length_vector;
    return {{base, middle + to_right, tip}, {base, tip, middle - to_right}};
}

std::vector<Triangle> make_cylinder(
    const Vec3& base,
    const Vec3& axis,
    double radius_base,
    double radius_top,
    int sides,
    bool capped) {
    EXPECT(sides >= 3 && radius_base >= 0 && radius_top >= 0);
    const Frame frame = frame_along(axis);
    const double growth = cone_growth(length(axis), radius_base - radius_top, sides);
    const std::vector<Vec3> low = make_ring(base, frame, growth * radius_base, sides);
    const std::vector<Vec3> high = make_ring(base + axis, frame, growth * radius_top, sides);

    std::vector<Triangle> triangles;
    const auto n = static_cast<std::size_t>(sides);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = (i + 1) % n;
        if (radius_base > 0 || radius_top == 0) {
            triangles.push_back({low[i], low[next], high[next]});
        }
        if (radius_top > 0) {
            triangles.push_back({low[i], high[next], high[i]});
        }
    }
    if (capped && radius_base > 0) {
        add_fan(triangles, {low.rbegin(), low.rend()});
    }
    if (capped && radius_top > 0) {
        add_fan(triangles, high);
    }
    return triangles;
}

std::vector<Triangle> make_disk(const Vec3& center, const Vec3& normal, double radius, int sides) {
    EXPECT(sides >= 3 && radius >= 0);
    const double angle = 2 * kPi / sides;
    const double growth = std::sqrt(angle / std::sin(angle));
    std::vector<Triangle> triangles;
    add_fan(triangles, make_ring(center, frame_along(normal), growth * radius, sides));
    return triangles;
}

namespace {

/// The icosahedron with corners at distance 1, upper sides outward: two caps of five triangles
/// about the poles and a belt of ten between them.
std::vector<Triangle> make_icosahedron() {
    const Vec3 top{0, 0, 1}, bottom{0, 0, -1};
    const double z = 1 / std::sqrt(5.0), r = 2 * z;
    const auto ring_corner = [&](int half_steps, double height) {
        const double angle = kPi / 5 * half_steps;
        return Vec3{r * std::cos(angle), r * std::sin(angle), height};
    };
    std::vector<Triangle> faces;
    for (int i = 0; i < 5; ++i) {
        const Vec3 high = ring_corner(2 * i, z), next_high = ring_corner(2 * i + 2, z);
        const Vec3 low = ring_corner(2 * i + 1, -z), next_low = ring_corner(2 * i + 3, -z);
        faces.push_back({top, high, next_high});
        faces.push_back({low, next_high, high});
        faces.push_back({next_high, low, next_low});
        faces.push_back({bottom, next_low, low});
    }
    return faces;
}

/// Every triangle of the unit sphere divided into four.
std::vector<Triangle> halved_on_sphere(const std::vector<Triangle>& triangles) {
    std::vector<Triangle> halved;
    for (const auto& [a, b, c] : triangles) {
        const Vec3 ab = normalized(a + b), bc = normalized(b + c), ca = normalized(c + a);
        halved.push_back({a, ab, ca});
        halved.push_back({ab, b, bc});
        halved.push_back({ca, bc, c});
        halved.push_back({ab, bc, ca});
    }
    return halved;
}

}  // namespace

std::vector<Triangle> make_sphere(const Vec3& center, double radius, int levels) {
    EXPECT(levels >= 0 && levels < 12 && radius >= 0);
    std::vector<Triangle> triangles = make_icosahedron();
    for (int level = 0; level < levels; ++level) {
        triangles = halved_on_sphere(triangles);
    }
    const double size = radius * std::sqrt(4 * kPi / area(triangles));
    for (Triangle& t : triangles) {
        for (Vec3& corner : t) {
            corner = center + size * corner;
        }
    }
    return triangles;
}

}  // namespace quasimc

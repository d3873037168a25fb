#include "scene/overlap/coplanar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "base/vec3.h"
#include "geometry/mesh/point2.h"

namespace quasimc {
namespace {

/// Twice the area, positive if counter-clockwise.
double area_of(const std::vector<Point2>& polygon) {
    double sum = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        sum += turn(polygon[0], polygon[i - 1], polygon[i]);
    }
    return sum;
}

/// The part of a polygon left of the line from a to b (Sutherland and Hodgman 1974).
std::vector<Point2> clipped(const std::vector<Point2>& polygon, const Point2& a, const Point2& b) {
    std::vector<Point2> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2& p = polygon[i];
        const Point2& q = polygon[(i + 1) % polygon.size()];
        const double at_p = turn(a, b, p);
        const double at_q = turn(a, b, q);
        if (at_p >= 0) {
            kept.push_back(p);
        }
        if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
            const double along = at_p / (at_p - at_q);
            kept.push_back({p.s + along * (q.s - p.s), p.t + along * (q.t - p.t)});
        }
    }
    return kept;
}

/// Whether `other` lies beyond a side of `t`, except for at most `tolerance`.
bool is_beyond_a_side(const Triangle& other, const Triangle& t, double tolerance) {
    const Vec3 n = area_vector(t);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 side = t[(i + 1) % 3] - t[i];
        const Vec3 outward = cross(side, n);
        constexpr double kRounding = 1e-9;
        const double slack = length(outward) * std::max(tolerance, kRounding * length(side));
        const bool all = std::all_of(other.begin(), other.end(), [&](const Vec3& corner) {
            return dot(outward, corner - t[i]) >= -slack;
        });
        if (all) {
            return true;
        }
    }
    return false;
}

using Polygon = std::vector<Point2>;

/// The plane of a triangle.
class Plane {
  public:
    explicit Plane(const Triangle& t)
        : origin_(t[0]), frame_(frame_about(normalized(area_vector(t)))) {}

    [[nodiscard]] Polygon flat(const Triangle& t) const {
        Polygon points;
        for (const Vec3& corner : t) {
            const Vec3 p = corner - origin_;
            points.push_back({dot(p, frame_.s), dot(p, frame_.t)});
        }
        return points;
    }
    [[nodiscard]] Vec3 point(const Point2& p) const {
        return origin_ + p.s * frame_.s + p.t * frame_.t;
    }

  private:
    Vec3 origin_;
    Frame frame_;
};

bool meet(const Polygon& a, const Polygon& b) {
    const auto is_apart = [&](double Point2::*axis) {
        const auto less = [&](const Point2& p, const Point2& q) { return p.*axis < q.*axis; };
        const auto [a_low, a_high] = std::minmax_element(a.begin(), a.end(), less);
        const auto [b_low, b_high] = std::minmax_element(b.begin(), b.end(), less);
        return (*a_high).*axis <= (*b_low).*axis || (*b_high).*axis <= (*a_low).*axis;
    };
    return !is_apart(&Point2::s) && !is_apart(&Point2::t);
}

/// Adds the parts of a convex polygon outside of a convex window to `parts`.
void add_parts_beside(Polygon polygon, const Polygon& window, std::vector<Polygon>& parts) {
    for (std::size_t i = 0; i < window.size() && polygon.size() >= 3; ++i) {
        const Point2& a = window[i];
        const Point2& b = window[(i + 1) % window.size()];
        Polygon outside = clipped(polygon, b, a);
        if (area_of(outside) > 0) {
            parts.push_back(std::move(outside));
        }
        polygon = clipped(polygon, a, b);
    }
}

}  // namespace

namespace {

/// Part of a convex polygon where `along` is at least 0.
std::vector<Vec3> clip_by(
    const std::vector<Vec3>& polygon, const std::function<double(const Vec3&)>& along) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3& p = polygon[i];
        const Vec3& q = polygon[(i + 1) % polygon.size()];
        const double from = along(p);
        const double to = along(q);
        if (from >= 0) {
            kept.push_back(p);
        }
        if ((from > 0 && to < 0) || (from < 0 && to > 0)) {
            kept.push_back(p + from / (from - to) * (q - p));
        }
    }
    return kept;
}

}  // namespace

std::vector<std::vector<Triangle>> parts_in_slabs(
    const Triangle& t, const Vec3& axis, double width) {
    constexpr double kRounding = 1e-9;
    const std::array<double, 3> at{dot(t[0], axis), dot(t[1], axis), dot(t[2], axis)};
    const auto [low, high] = std::minmax_element(at.begin(), at.end());
    const auto slabs =
        static_cast<std::size_t>(std::max(1.0, std::ceil((*high - *low) / width - kRounding)));
    std::vector<std::vector<Triangle>> parts;
    for (std::size_t slab = 0; slab < slabs; ++slab) {
        const double from = *low + static_cast<double>(slab) * width;
        const double to = slab + 1 < slabs ? from + width : *high;
        std::vector<Vec3> polygon(t.begin(), t.end());
        polygon = clip_by(polygon, [&](const Vec3& p) { return dot(p, axis) - from; });
        polygon = clip_by(polygon, [&](const Vec3& p) { return to - dot(p, axis); });
        std::vector<Triangle>& own = parts.emplace_back();
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            own.push_back({polygon[0], polygon[i - 1], polygon[i]});
        }
    }
    return parts;
}

std::vector<Triangle> parts_beside(
    const Triangle& t, const std::vector<Triangle>& windows, double tolerance) {
    const Plane plane(t);
    std::vector<Polygon> parts{plane.flat(t)};
    for (const Triangle& w : windows) {
        if (parts.empty()) {
            break;
        }
        Polygon window = plane.flat(w);
        if (area_of(window) < 0) {
            std::reverse(window.begin(), window.end());
        }
        std::vector<Polygon> rest;
        for (Polygon& part : parts) {
            if (meet(part, window)) {
                add_parts_beside(std::move(part), window, rest);
            } else {
                rest.push_back(std::move(part));
            }
        }
        parts = std::move(rest);
    }
    std::vector<Triangle> triangles;
    for (const Polygon& part : parts) {
        for (std::size_t i = 2; i < part.size(); ++i) {
            const Triangle piece{
                plane.point(part[0]), plane.point(part[i - 1]), plane.point(part[i])};
            if (size_of(bounds_of(piece)) > 0 && height(piece) > tolerance) {
                triangles.push_back(piece);
            }
        }
    }
    return triangles;
}

double size_of(const Bounds& bounds) {
    const Vec3 size = bounds.size();
    return std::max({size.x, size.y, size.z});
}

double height(const Triangle& t) {
    const auto square = [](const Vec3& v) { return dot(v, v); };
    const double longest =
        std::max({square(t[1] - t[0]), square(t[2] - t[1]), square(t[0] - t[2])});
    return length(area_vector(t)) / std::sqrt(longest);
}

bool lies_in_plane(const Triangle& small, const Triangle& large, double tolerance) {
    const Vec3 n = normalized(area_vector(large));
    return std::all_of(small.begin(), small.end(), [&](const Vec3& corner) {
        return std::abs(dot(n, corner - large[0])) <= tolerance;
    });
}

bool is_same(const Triangle& a, const Triangle& b, double tolerance) {
    return std::all_of(a.begin(), a.end(), [&](const Vec3& p) {
        return std::any_of(
            b.begin(), b.end(), [&](const Vec3& q) { return length(p - q) <= tolerance; });
    });
}

bool meet(const Bounds& a, const Bounds& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
           b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

bool lie_apart(const Triangle& a, const Triangle& b, double tolerance) {
    return is_beyond_a_side(b, a, tolerance) || is_beyond_a_side(a, b, tolerance);
}

double covered_part(const Triangle& small, const Triangle& large) {
    const Frame frame = frame_about(normalized(area_vector(large)));
    const auto flat = [&](const Triangle& t) {
        std::vector<Point2> points;
        for (const Vec3& corner : t) {
            const Vec3 p = corner - large[0];
            points.push_back({dot(p, frame.s), dot(p, frame.t)});
        }
        return points;
    };
    const std::vector<Point2> window = flat(large);
    std::vector<Point2> rest = flat(small);
    const double whole = std::abs(area_of(rest));
    for (std::size_t i = 0; i < 3; ++i) {
        rest = clipped(rest, window[i], window[(i + 1) % 3]);
    }
    return std::abs(area_of(rest)) / whole;
}

}  // namespace quasimc

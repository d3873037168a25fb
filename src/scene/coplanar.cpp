#include "scene/coplanar.h"

#include <algorithm>
#include <cmath>
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

/// Whether `other` lies wholly beyond one of the sides of `t`.
bool is_beyond_a_side(const Triangle& other, const Triangle& t) {
    const Vec3 n = area_vector(t);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 side = t[(i + 1) % 3] - t[i];
        const Vec3 outward = cross(side, n);
        constexpr double kRounding = 1e-9;
        const double slack = kRounding * length(outward) * length(side);
        const bool all = std::all_of(other.begin(), other.end(), [&](const Vec3& corner) {
            return dot(outward, corner - t[i]) >= -slack;
        });
        if (all) {
            return true;
        }
    }
    return false;
}

}  // namespace

double size_of(const Bounds& bounds) {
    const Vec3 size = bounds.size();
    return std::max({size.x, size.y, size.z});
}

double height(const Triangle& t) {
    const double longest =
        std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
    return length(area_vector(t)) / longest;
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

bool lie_apart(const Triangle& a, const Triangle& b) {
    return is_beyond_a_side(b, a) || is_beyond_a_side(a, b);
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

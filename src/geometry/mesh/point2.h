#pragma once

#include <cmath>

namespace quasimc {

/// A point of a plane.
struct Point2 {
    double s = 0, t = 0;
};

/// Twice the area of the triangle a, b, c; positive when they turn left.
[[nodiscard]] constexpr double turn(const Point2& a, const Point2& b, const Point2& c) {
    return (b.s - a.s) * (c.t - a.t) - (b.t - a.t) * (c.s - a.s);
}

/// A straight segment between two points.
struct PlaneSegment {
    Point2 from, to;
};
[[nodiscard]] inline double length_of(const PlaneSegment& segment) {
    return std::hypot(segment.to.s - segment.from.s, segment.to.t - segment.from.t);
}

}  // namespace quasimc

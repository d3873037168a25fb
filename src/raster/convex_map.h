#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "geometry/mesh/point2.h"

namespace quasimc {

/// The corners of the convex hull of `points`, counter-clockwise; fewer than three for collinear
/// points.
[[nodiscard]] std::vector<Point2> convex_hull(std::vector<Point2> points);

/// Area of a polygon with counter-clockwise corners.
[[nodiscard]] double polygon_area(const std::vector<Point2>& corners);

/// An area-preserving, continuous map of the unit square onto a convex polygon: lines of equal u0
/// become chords along t, positioned along s so that equal steps of u0 sweep equal areas; u1 runs
/// along the chord.
class ConvexMap {
  public:
    /// @param hull  a convex polygon of nonzero area, corners counter-clockwise
    explicit ConvexMap(const std::vector<Point2>& hull);

    [[nodiscard]] double area() const { return area_; }
    [[nodiscard]] Point2 point(double u0, double u1) const;

  private:
    /// The part of the polygon between two neighbouring corners along s: a trapezium. One cache
    /// line.
    struct alignas(64) Slab {
        double s = 0, width = 0;            ///< begin and extent along s
        double low = 0, low_slope = 0;      ///< lower border at the beginning, and its slope
        double chord = 0, chord_slope = 0;  ///< length of the chord at the beginning, and its slope
        double area_before = 0;             ///< sum over the previous slabs
        double area_after = 0;              ///< including this one
    };

    static constexpr std::size_t kGuides = 1024;

    std::vector<Slab> slabs_;
    std::vector<std::uint16_t>
        guide_;  ///< the slab at the beginning of each equal part of the area
    double area_ = 0;
};

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "base/notices.h"
#include "growth/turtle/turtle_frame.h"
#include "growth/view/view.h"

namespace quasimc {

/// A tangent of the radius at an end of a segment, in the plane of the position along the segment
/// and the radius. Zero: that of a linear radius.
struct RadiusTangent {
    double along = 0, radius = 0;
};

/// Settings of generalized cylinders, which brackets restore.
struct CylinderSettings {
    static constexpr int kCircle = -1;

    int contour = kCircle;
    int sides = 8;
    double tangent_in = 1.2, tangent_out = 1.2;  ///< at the end and at the start of segments
    RadiusTangent radius_in, radius_out;
};

/// A point of the axis of a generalized cylinder.
struct CylinderPoint {
    Vec3 position;
    HeadingAndUp axes;
    double radius = 0;
    CylinderSettings settings;
    int strips = 4;  ///< between the previous point and this one
};

/// A ring about the axis; its number of sides is 0 before the first ring.
struct CylinderRing {
    HeadingAndUp axes;
    int sides = 0;
};

/// Rows of triangles along an axis, and their last ring.
struct CylinderStrips {
    std::vector<Triangle> triangles;
    CylinderRing ring;
};

/// The axis of a generalized cylinder whose points are given together: '{(1)' to '{(4)'.
enum class CylinderCurve { hermite = 1, closed_hermite, b_spline, closed_b_spline };

/// Makes generalized cylinders: contours swept along a Hermite curve or a uniform cubic B-spline.
class CylinderMaker {
  public:
    /// @param view, notices  outlive it
    CylinderMaker(const View& view, Notices& notices) : view_(view), notices_(notices) {}

    /// One segment of a Hermite curve, from a ring. Empty if the points are equal.
    [[nodiscard]] CylinderStrips segment(
        const CylinderPoint& from, const CylinderPoint& to, const CylinderRing& ring);
    /// All segments of a curve; none if it has too few points.
    [[nodiscard]] std::vector<Triangle> whole(
        std::span<const CylinderPoint> points, CylinderCurve curve);

  private:
    using Outline = std::vector<ContourPoint>;  // sides + 1 points

    [[nodiscard]] const Outline& outline(const CylinderPoint& point, int sides);

    const View& view_;
    Notices& notices_;
    std::map<std::pair<int, int>, Outline> outlines_;  // by contour and sides
};

}  // namespace quasimc

#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "raster/projected_scene.h"

namespace quasimc {

/// Intersections of rows with the sides of a triangle. Each side is followed from its lower end up,
/// so that triangles sharing it are cut at the same points.
class SidesByRow {
  public:
    explicit SidesByRow(const ProjectedTriangle& seen) {
        const auto [low, middle, high] = seen.upwards();
        const auto& x = seen.x;
        const auto& y = seen.y;
        low_x_ = x[low];
        low_y_ = y[low];
        middle_x_ = x[middle];
        middle_y_ = y[middle];
        slope_long_ = (x[high] - x[low]) / (y[high] - y[low]);
        slope_low_ = (x[middle] - x[low]) / (y[middle] - y[low]);
        slope_high_ = (x[high] - x[middle]) / (y[high] - y[middle]);
    }

    /// Left and right of a row between the lowest and the highest corner.
    [[nodiscard]] std::pair<double, double> at(double row) const {
        const double along = low_x_ + (row - low_y_) * slope_long_;
        const double other = row < middle_y_ ? low_x_ + (row - low_y_) * slope_low_
                                             : middle_x_ + (row - middle_y_) * slope_high_;
        return {std::min(along, other), std::max(along, other)};
    }

  private:
    double low_x_, low_y_, middle_x_, middle_y_, slope_long_, slope_low_, slope_high_;
};

/// A linear function on the plane of a beam: at + by_x x + by_y y.
struct PlaneGradient {
    double at = 0, by_x = 0, by_y = 0;
};

/// Gradients of depth and barycentric coordinates over the projection of a triangle.
class TrianglePlane {
  public:
    explicit TrianglePlane(const ProjectedTriangle& c)
        : ax_(c.x[1] - c.x[0]),
          ay_(c.y[1] - c.y[0]),
          bx_(c.x[2] - c.x[0]),
          by_(c.y[2] - c.y[0]),
          x_(c.x[0]),
          y_(c.y[0]),
          twice_area_(ax_ * by_ - ay_ * bx_),
          per_area_(1 / twice_area_) {}

    /// Whether the triangle is edge-on: corners have single precision.
    [[nodiscard]] bool is_edge_on() const {
        constexpr double kFlat = 0x1p-24;
        return std::abs(twice_area_) <= kFlat * (ax_ * ax_ + ay_ * ay_ + bx_ * bx_ + by_ * by_);
    }
    /// Whether the corners turn left, with x to the right and y up.
    [[nodiscard]] bool turns_left() const { return twice_area_ > 0; }
    /// The gradient of a quantity that is `first` at the first corner, and more by a and b at the
    /// others.
    [[nodiscard]] PlaneGradient gradient(double first, double a, double b) const {
        const double by_x = (a * by_ - b * ay_) * per_area_;
        const double by_y = (b * ax_ - a * bx_) * per_area_;
        return {first - by_x * x_ - by_y * y_, by_x, by_y};
    }

  private:
    double ax_, ay_, bx_, by_, x_, y_, twice_area_, per_area_;
};

}  // namespace quasimc

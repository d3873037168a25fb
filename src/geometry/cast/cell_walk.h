#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vec3.h"
#include "geometry/cast/intersector.h"
#include "geometry/cast/rounding.h"
#include "geometry/mesh/cell.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// Overlap of the pieces of a ray in neighbouring cells, so that rounding can't miss anything on
/// the border. Smaller than the margin of wrap_into_cell.
inline constexpr double kOverlap = 0x1p-20;

/// The region of a walk: the cell along periodic axes, the scene's bounds along the others.
struct Tile {
    Bounds box;  ///< local coordinates
    bool along_x = false, along_y = false;
};

/// The pieces of a ray in a scene that is periodic along x, y or both, cell by cell, each moved
/// into the one cell of the mesh. Lengths and positions have double precision, so that long rays
/// stay accurate.
class CellWalk {
  public:
    CellWalk(const Tile& tile, const Vec3& origin, const Vec3& direction)
        : origin_(origin), direction_(direction) {
        if (!tile.along_x) {
            clip(tile.box.low.x, tile.box.high.x, origin.x, direction.x);
        }
        if (!tile.along_y) {
            clip(tile.box.low.y, tile.box.high.y, origin.y, direction.y);
        }
        clip(tile.box.low.z, tile.box.high.z, origin.z, direction.z);
        if (tile.along_x) {
            x_ = Axis(tile.box.low.x, tile.box.high.x, origin.x, direction.x, enter_);
        }
        if (tile.along_y) {
            y_ = Axis(tile.box.low.y, tile.box.high.y, origin.y, direction.y, enter_);
        }
        start_ = enter_;
        border_ = std::min({x_.next, y_.next, leave_});
    }

    /// False once the ray has left the scene.
    [[nodiscard]] bool inside() const { return start_ < leave_; }
    /// Distance from the ray's origin to the start of the current piece.
    [[nodiscard]] double start() const { return start_; }
    /// Number of periods by which the current piece was moved.
    [[nodiscard]] double shift_x() const { return x_.index; }
    [[nodiscard]] double shift_y() const { return y_.index; }

    /// The current piece, in the coordinates of the mesh.
    [[nodiscard]] Ray piece() const {
        const Vec3 p = origin_ + start_ * direction_;
        return {
            {p.x - x_.index * x_.size, p.y - y_.index * y_.size, p.z},
            direction_,
            std::max(0.0F, static_cast<float>(kNear - start_)),
            static_cast<float>(border_ - start_ + kOverlap)};
    }

    /// Advances to the next cell.
    void step() {
        if (border_ >= leave_) {
            start_ = leave_;
            return;
        }
        if (x_.next <= y_.next) {
            x_.step();
        } else {
            y_.step();
        }
        start_ = std::max(enter_, border_ - kOverlap);
        border_ = std::min({x_.next, y_.next, leave_});
    }

  private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();

    /// Progress along one periodic axis.
    struct Axis {
        double size = 0;             ///< the period
        double index = 0;            ///< of the current cell; that of the mesh is 0
        double next = kInfinity;     ///< distance to the border of the next cell
        double forward = 0;          ///< 1 or -1, change of the index there
        double spacing = kInfinity;  ///< between borders

        Axis() = default;
        Axis(double low, double high, double origin, double direction, double enter)
            : size(high - low), index(std::floor((origin + enter * direction - low) / size)) {
            if (direction != 0) {
                forward = direction > 0 ? 1 : -1;
                spacing = size / std::abs(direction);
                next = (low + (index + (direction > 0 ? 1 : 0)) * size - origin) / direction;
            }
        }
        void step() {
            index += forward;
            next += spacing;
        }
    };

    /// Clips to the slab between two planes.
    void clip(double low, double high, double origin, double direction) {
        if (direction == 0) {
            if (origin < low || origin > high) {
                leave_ = -kInfinity;
            }
            return;
        }
        const double inverse = 1 / direction;
        const double to_low = (low - origin) * inverse, to_high = (high - origin) * inverse;
        enter_ = std::max(enter_, std::min(to_low, to_high));
        leave_ = std::min(leave_, std::max(to_low, to_high));
    }

    Vec3 origin_, direction_;
    double enter_ = 0, leave_ = kInfinity;
    double start_ = 0, border_ = 0;
    Axis x_, y_;
};

}  // namespace quasimc

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace quasimc {

/// A grid over the bounds of points that finds the cells inside their convex hull.
///
/// A point lies in the hull if each of the eight octants about it contains a point: a plane that
/// separated it from all points would leave one octant wholly on its far side. So a cell lies in
/// the hull if each of the octants of cells beyond it contains a cell with a point.
class OctantGrid {
  public:
    /// The grid of the points that `for_each` visits. @param points  approximate number
    template <typename ForEach>
    OctantGrid(const ForEach& for_each, const Bounds& bounds, std::size_t points)
        : OctantGrid(bounds, points) {
        for_each([&](const Vec3& p) { octants_[index(cell_of(p))] = 0xFF; });
        spread();
    }

    /// Whether the cell of `p` lies in the hull; false if uncertain.
    [[nodiscard]] bool is_inside(const Vec3& p) const;

  private:
    using Cell3 = std::array<int, 3>;

    OctantGrid(const Bounds& bounds, std::size_t points);
    [[nodiscard]] std::size_t index(const Cell3& c) const {
        return (static_cast<std::size_t>(c[2]) * count_[1] + c[1]) * count_[0] + c[0];
    }
    [[nodiscard]] Cell3 cell_of(const Vec3& p) const;
    [[nodiscard]] bool holds(const Cell3& c, std::size_t octant) const {
        return ((octants_[index(c)] >> octant) & 1U) != 0;
    }
    /// Propagates each cell's points to the previous cells.
    void spread();
    void spread(std::size_t octant);
    void mark(const Cell3& cell, std::size_t octant);

    Vec3 low_;
    std::array<int, 3> count_{};
    std::array<double, 3> per_unit_{};
    std::vector<std::uint8_t> octants_;  // one bit per octant: whether it contains a point
};

/// The points visited by `for_each` that may be corners of their convex hull, in order: all except
/// those that certainly are not. Few points of a large mesh remain.
/// @param cells  resolution: approximate number of corners of the triangles
template <typename ForEach>
std::vector<Vec3> outline_of(const ForEach& for_each, const Bounds& bounds, std::size_t cells) {
    const OctantGrid grid(for_each, bounds, cells);
    std::vector<Vec3> outline;
    for_each([&](const Vec3& p) {
        if (!grid.is_inside(p)) {
            outline.push_back(p);
        }
    });
    return outline;
}

/// The outline of a mesh that may have many copies: little more than the corners of its hull.
[[nodiscard]] std::vector<Vec3> outline_points(std::span<const Vec3> points, std::size_t cells);

}  // namespace quasimc

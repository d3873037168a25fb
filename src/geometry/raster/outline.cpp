#include "geometry/raster/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "quasimc/vec3.h"

namespace quasimc {

namespace {

constexpr std::size_t kOctants = 8;

/// A grid over the mesh's bounds that knows which of its cells lie inside the convex hull of the
/// points.
///
/// A point lies in the hull if each of the eight octants about it holds a point: a plane that
/// parted it from all points would leave one octant wholly on its far side. So a cell lies in the
/// hull if each of the octants of cells beyond it holds a cell with a point in it.
class OctantGrid {
  public:
    OctantGrid(const Bounds& bounds, std::size_t points) : low_(bounds.low) {
        const double cells = std::clamp(std::cbrt(static_cast<double>(points) / 4), 2.0, 96.0);
        const Vec3 size = bounds.size();
        const std::array<double, 3> sizes{size.x, size.y, size.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // Along an axis without extent there is one cell, which counts as beyond itself.
            count_[axis] = sizes[axis] > 0 ? static_cast<int>(cells) : 1;
            per_unit_[axis] = sizes[axis] > 0 ? count_[axis] / sizes[axis] : 0;
        }
        octants_.resize(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2], 0);
    }

    void add(const Vec3& p) { octants_[index(cell_of(p))] = 0xFF; }

    /// To be called when all points are added: spreads each cell's points to the cells before it.
    void finish() {
        for (std::size_t octant = 0; octant < kOctants; ++octant) {
            spread(octant);
        }
    }

    /// Whether the cell of `p` lies in the hull; false if in doubt.
    [[nodiscard]] bool is_inside(const Vec3& p) const {
        const Cell3 cell = cell_of(p);
        for (std::size_t octant = 0; octant < kOctants; ++octant) {
            Cell3 beyond = cell;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                beyond[axis] += count_[axis] > 1 ? step(octant, axis) : 0;
                if (beyond[axis] < 0 || beyond[axis] >= count_[axis]) {
                    return false;
                }
            }
            if (!holds(beyond, octant)) {
                return false;
            }
        }
        return true;
    }

  private:
    using Cell3 = std::array<int, 3>;

    static int step(std::size_t octant, std::size_t axis) {
        return ((octant >> axis) & 1U) != 0 ? 1 : -1;
    }
    [[nodiscard]] std::size_t index(const Cell3& c) const {
        return (static_cast<std::size_t>(c[2]) * count_[1] + c[1]) * count_[0] + c[0];
    }
    [[nodiscard]] Cell3 cell_of(const Vec3& p) const {
        const Vec3 q = p - low_;
        const std::array<double, 3> place{q.x, q.y, q.z};
        Cell3 cell{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            cell[axis] =
                std::min(static_cast<int>(place[axis] * per_unit_[axis]), count_[axis] - 1);
        }
        return cell;
    }
    [[nodiscard]] bool holds(const Cell3& c, std::size_t octant) const {
        return ((octants_[index(c)] >> octant) & 1U) != 0;
    }

    /// A cell's octant, itself included, holds a point if its own cell does or a neighbour's octant
    /// does.
    void spread(std::size_t octant) {
        Cell3 order{};
        const auto place = [&](std::size_t axis) {
            return step(octant, axis) > 0 ? count_[axis] - 1 - order[axis] : order[axis];
        };
        for (order[2] = 0; order[2] < count_[2]; ++order[2]) {
            for (order[1] = 0; order[1] < count_[1]; ++order[1]) {
                for (order[0] = 0; order[0] < count_[0]; ++order[0]) {
                    mark(Cell3{place(0), place(1), place(2)}, octant);
                }
            }
        }
    }

    void mark(const Cell3& cell, std::size_t octant) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Cell3 next = cell;
            next[axis] += step(octant, axis);
            if (next[axis] >= 0 && next[axis] < count_[axis] && holds(next, octant)) {
                octants_[index(cell)] |= static_cast<std::uint8_t>(1U << octant);
            }
        }
    }

    Vec3 low_;
    std::array<int, 3> count_{};
    std::array<double, 3> per_unit_{};
    std::vector<std::uint8_t> octants_;  // a bit for each octant: whether it holds a point
};

}  // namespace

namespace {

/// Those of the points that `for_each` visits that may be corners of their hull.
template <typename ForEach>
std::vector<Vec3> points_of_outline(
    const ForEach& for_each, const Bounds& bounds, std::size_t cells) {
    OctantGrid grid(bounds, cells);
    for_each([&](const Vec3& p) { grid.add(p); });
    grid.finish();
    std::vector<Vec3> outline;
    for_each([&](const Vec3& p) {
        if (!grid.is_inside(p)) {
            outline.push_back(p);
        }
    });
    return outline;
}

}  // namespace

std::vector<Vec3> outline_points(std::span<const Vec3> points, std::size_t cells) {
    Bounds bounds;
    for (const Vec3& p : points) {
        bounds.add(p);
    }
    const auto for_each = [&](const auto& visit) {
        std::for_each(points.begin(), points.end(), visit);
    };
    return points_of_outline(for_each, bounds, cells);
}

std::vector<Vec3> outline_points(const LocalMesh& mesh) {
    const auto for_each = [&](const auto& visit) { for_each_outer_vertex(mesh, visit); };
    return points_of_outline(for_each, mesh.bounds(), std::size_t{3} * mesh.triangle_count());
}

}  // namespace quasimc

#include "geometry/mesh/outline.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/inner_polyhedron.h"
#include "quasimc/mesh.h"

namespace quasimc {
namespace {

constexpr std::size_t kOctants = 8;
/// Number of points from which a polyhedron is built to leave out more of them.
constexpr std::size_t kWorthIt = 64;

int step(std::size_t octant, std::size_t axis) {
    return ((octant >> axis) & 1U) != 0 ? 1 : -1;
}

}  // namespace

OctantGrid::OctantGrid(const Bounds& bounds, std::size_t points) : low_(bounds.low) {
    const double cells = std::clamp(std::cbrt(static_cast<double>(points) / 4), 2.0, 96.0);
    const Vec3 size = bounds.size();
    const std::array<double, 3> sizes{size.x, size.y, size.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // An axis without extent has one cell, which is its own neighbour.
        count_[axis] = sizes[axis] > 0 ? static_cast<int>(cells) : 1;
        per_unit_[axis] = sizes[axis] > 0 ? count_[axis] / sizes[axis] : 0;
    }
    octants_.resize(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2], 0);
}

void OctantGrid::spread() {
    for (std::size_t octant = 0; octant < kOctants; ++octant) {
        spread(octant);
    }
}

bool OctantGrid::is_inside(const Vec3& p) const {
    if (octants_.size() == 1) {
        return false;  // all points are equal, and one of them has to remain
    }
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

OctantGrid::Cell3 OctantGrid::cell_of(const Vec3& p) const {
    const Vec3 q = p - low_;
    const std::array<double, 3> from_low{q.x, q.y, q.z};
    Cell3 cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        cell[axis] = std::min(static_cast<int>(from_low[axis] * per_unit_[axis]), count_[axis] - 1);
    }
    return cell;
}

/// A cell's octant, itself included, contains a point if its own cell does or a neighbour's octant
/// does.
void OctantGrid::spread(std::size_t octant) {
    Cell3 order{};
    const auto index = [&](std::size_t axis) {
        return step(octant, axis) > 0 ? count_[axis] - 1 - order[axis] : order[axis];
    };
    for (order[2] = 0; order[2] < count_[2]; ++order[2]) {
        for (order[1] = 0; order[1] < count_[1]; ++order[1]) {
            for (order[0] = 0; order[0] < count_[0]; ++order[0]) {
                mark(Cell3{index(0), index(1), index(2)}, octant);
            }
        }
    }
}

void OctantGrid::mark(const Cell3& cell, std::size_t octant) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Cell3 next = cell;
        next[axis] += step(octant, axis);
        if (next[axis] >= 0 && next[axis] < count_[axis] && holds(next, octant)) {
            octants_[index(cell)] |= static_cast<std::uint8_t>(1U << octant);
        }
    }
}

std::vector<Vec3> outline_points(std::span<const Vec3> points, std::size_t cells) {
    Bounds bounds;
    for (const Vec3& p : points) {
        bounds.add(p);
    }
    const auto for_each = [&](const auto& visit) {
        std::for_each(points.begin(), points.end(), visit);
    };
    std::vector<Vec3> outline = outline_of(for_each, bounds, cells);
    if (outline.size() >= kWorthIt) {
        const InnerPolyhedron inner(outline);
        std::erase_if(outline, [&](const Vec3& p) { return inner.holds(p); });
    }
    return outline;
}

}  // namespace quasimc

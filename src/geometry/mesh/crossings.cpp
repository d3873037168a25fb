#include "geometry/mesh/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include "base/stop.h"

namespace quasimc {
namespace {

namespace bg = boost::geometry;
using BoxPoint = bg::model::point<float, 3, bg::cs::cartesian>;
using Box = bg::model::box<BoxPoint>;
using BoxedTriangle = std::pair<Box, std::uint32_t>;
using BoxTree = bg::index::rtree<BoxedTriangle, bg::index::linear<16>>;

/// A corner within this distance of a plane, in local coordinates, lies in it: some roundings of
/// the corners.
constexpr double kInPlane = 0x1p-22;
/// Relative to the side of a triangle: segments within this distance of its border are the border.
constexpr double kOnBorder = 1e-5;

/// A triangle and its plane.
struct PlaneTriangle {
    std::array<Vec3, 3> corners;
    Vec3 side, other_side, across;

    PlaneTriangle(const LocalMesh& mesh, std::uint32_t i)
        : corners{mesh.vertex(i, 0), mesh.vertex(i, 1), mesh.vertex(i, 2)},
          side(corners[1] - corners[0]),
          other_side(corners[2] - corners[0]),
          across(cross(side, other_side)) {}

    [[nodiscard]] Point2 coordinates(const Vec3& p) const {
        const Vec3 from = p - corners[0];
        const double square = dot(across, across);
        return {
            dot(cross(from, other_side), across) / square, dot(cross(side, from), across) / square};
    }
};

/// Distances of the corners of `of` from the plane of `plane`.
std::array<double, 3> distances(const PlaneTriangle& of, const PlaneTriangle& plane) {
    const Vec3 normal = normalized(plane.across);
    std::array<double, 3> d{};
    for (std::size_t i = 0; i < 3; ++i) {
        d[i] = dot(normal, of.corners[i] - plane.corners[0]);
        d[i] = std::abs(d[i]) <= kInPlane ? 0 : d[i];
    }
    return d;
}

/// The intersection of a triangle and a plane, if it is a segment.
std::optional<std::pair<Vec3, Vec3>> cut_by_plane(
    const PlaneTriangle& t, const std::array<double, 3>& d) {
    std::array<Vec3, 3> found;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if (d[i] == 0) {
            found[count++] = t.corners[i];
        } else if (d[i] * d[next] < 0) {
            const double f = d[i] / (d[i] - d[next]);
            found[count++] = t.corners[i] + f * (t.corners[next] - t.corners[i]);
        }
    }
    if (count != 2) {  // it is in the plane, touches it with a corner, or misses it
        return std::nullopt;
    }
    return std::pair{found[0], found[1]};
}

/// The part of a line from `from` to `to` on a triangle, unless it is part of its border.
std::optional<PlaneSegment> clip(const Point2& from, const Point2& to) {
    const auto heights = [](const Point2& p) { return std::array{p.s, p.t, 1 - p.s - p.t}; };
    const std::array<double, 3> a = heights(from);
    const std::array<double, 3> b = heights(to);
    double low = 0, high = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        if (a[i] < 0 && b[i] < 0) {
            return std::nullopt;
        }
        const double at = a[i] / (a[i] - b[i]);
        if (a[i] < 0) {
            low = std::max(low, at);
        } else if (b[i] < 0) {
            high = std::min(high, at);
        }
    }
    if (!(low < high)) {
        return std::nullopt;
    }
    const auto point = [&](double f) {
        return Point2{from.s + f * (to.s - from.s), from.t + f * (to.t - from.t)};
    };
    const PlaneSegment crossing{point(low), point(high)};
    const std::array<double, 3> c = heights(crossing.from);
    const std::array<double, 3> d = heights(crossing.to);
    for (std::size_t i = 0; i < 3; ++i) {
        if (c[i] < kOnBorder && d[i] < kOnBorder) {
            return std::nullopt;
        }
    }
    return length_of(crossing) > kOnBorder ? std::optional(crossing) : std::nullopt;
}

/// The segment where `other` crosses or touches `own`.
std::optional<PlaneSegment> crossing_of(const PlaneTriangle& own, const PlaneTriangle& other) {
    const auto cut = cut_by_plane(other, distances(other, own));
    return cut ? clip(own.coordinates(cut->first), own.coordinates(cut->second)) : std::nullopt;
}

Box box_of(const LocalMesh& mesh, std::uint32_t i) {
    Bounds bounds;
    for (int corner = 0; corner < 3; ++corner) {
        bounds.add(mesh.vertex(i, corner));
    }
    const auto point = [](const Vec3& p, double blur) {
        return BoxPoint(
            static_cast<float>(p.x + blur), static_cast<float>(p.y + blur),
            static_cast<float>(p.z + blur));
    };
    return {point(bounds.low, -kInPlane), point(bounds.high, kInPlane)};
}

}  // namespace

std::size_t most_compared_for_crossings(std::size_t triangles) {
    return 10'000'000 + 500 * triangles;
}

std::size_t most_crossings(std::size_t triangles) {
    return 20'000 + 32 * triangles;
}

SurfaceCrossings find_crossings(const LocalMesh& mesh, const std::stop_token& stop) {
    std::vector<BoxedTriangle> boxes;
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        if (length(mesh.across(i)) > 0) {
            boxes.emplace_back(box_of(mesh, i), i);
        }
    }
    const BoxTree tree(boxes);
    SurfaceCrossings crossings;
    std::vector<BoxedTriangle> near;
    std::size_t compared = 0;
    for (const auto& [box, i] : boxes) {
        throw_if_stopped(stop);
        near.clear();
        tree.query(bg::index::intersects(box), std::back_inserter(near));
        compared += near.size();
        if (compared > most_compared_for_crossings(boxes.size())) {
            return {.found = {}, .gave_up = true};
        }
        std::sort(near.begin(), near.end(), [](const BoxedTriangle& a, const BoxedTriangle& b) {
            return a.second < b.second;
        });
        const PlaneTriangle own(mesh, i);
        for (const auto& [other_box, other] : near) {
            const auto crossing =
                other == i ? std::nullopt : crossing_of(own, PlaneTriangle(mesh, other));
            if (crossing) {
                crossings.found.push_back({i, other, crossing->from, crossing->to});
            }
        }
        if (crossings.found.size() > most_crossings(boxes.size())) {
            return {.found = {}, .gave_up = true};
        }
    }
    return crossings;
}

}  // namespace quasimc

#include "geometry/mesh/inner_polyhedron.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace quasimc {
namespace {

/// Number of directions in which the outermost points are corners.
constexpr std::size_t kDirections = 256;
/// Rounding of distances, as a fraction of the size of the points' bounds.
constexpr double kDistanceRounding = 1e-12;

using Edge = std::array<Vec3, 2>;

/// Direction `i` of a spiral over the sphere.
Vec3 spiral(std::size_t i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / kDirections;
    const double angle = 2 * std::numbers::pi / std::numbers::phi * static_cast<double>(i);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

/// The points that are the outermost in a direction, each once.
std::vector<Vec3> outermost(std::span<const Vec3> points, const Vec3& size) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < kDirections; ++i) {
        const Vec3 d = spiral(i);
        // In the proportions of the bounds, so that flat meshes have as many corners as others.
        const Vec3 direction{
            size.x > 0 ? d.x / size.x : 0, size.y > 0 ? d.y / size.y : 0,
            size.z > 0 ? d.z / size.z : 0};
        const auto most = std::max_element(
            points.begin(), points.end(),
            [&](const Vec3& a, const Vec3& b) { return dot(direction, a) < dot(direction, b); });
        found.push_back(static_cast<std::size_t>(most - points.begin()));
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    std::vector<Vec3> corners;
    corners.reserve(found.size());
    for (const std::size_t i : found) {
        corners.push_back(points[i]);
    }
    return corners;
}

/// Swaps the point with the largest measure with that at index `first`. @return its measure
template <typename Measure>
double swap_first(std::vector<Vec3>& points, std::size_t first, const Measure& measure) {
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(first);
    const auto most = std::max_element(
        begin, points.end(), [&](const Vec3& a, const Vec3& b) { return measure(a) < measure(b); });
    std::swap(*begin, *most);
    return measure(*begin);
}

}  // namespace

InnerPolyhedron::InnerPolyhedron(std::span<const Vec3> points) {
    Bounds bounds;
    for (const Vec3& p : points) {
        bounds.add(p);
    }
    tolerance_ = kDistanceRounding * (length(bounds.low) + length(bounds.size()));
    std::vector<Vec3> corners = outermost(points, bounds.size());
    if (start(corners)) {
        for (std::size_t i = 4; i < corners.size(); ++i) {
            include(corners[i]);
        }
    }
}

bool InnerPolyhedron::holds(const Vec3& p) const {
    const auto is_inside = [&](const Facet& facet) {
        return facet.outward == Vec3{} || dot(facet.outward, p) < facet.height - tolerance_;
    };
    return !facets_.empty() && std::all_of(facets_.begin(), facets_.end(), is_inside);
}

void InnerPolyhedron::add_facet(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = cross(b - a, c - a);
    const double area = length(normal);
    const Vec3 outward = area > 0 ? normal / area : Vec3{};
    facets_.push_back({{a, b, c}, outward, dot(outward, a)});
}

/// Starts with a tetrahedron of the first four points, after ordering them. Whether there is one.
bool InnerPolyhedron::start(std::vector<Vec3>& points) {
    if (points.size() < 4) {
        return false;
    }
    const auto from_first = [&](const Vec3& p) { return length(p - points[0]); };
    swap_first(points, 1, from_first);
    const Vec3 along = points[1] - points[0];
    swap_first(points, 2, [&](const Vec3& p) { return length(cross(along, p - points[0])); });
    const Vec3 across = cross(along, points[2] - points[0]);
    const double volume =
        swap_first(points, 3, [&](const Vec3& p) { return std::abs(dot(across, p - points[0])); });
    if (volume <= tolerance_ * length(across)) {
        return false;
    }
    if (dot(across, points[3] - points[0]) > 0) {
        std::swap(points[1], points[2]);
    }
    add_facet(points[0], points[1], points[2]);
    add_facet(points[0], points[3], points[1]);
    add_facet(points[1], points[3], points[2]);
    add_facet(points[2], points[3], points[0]);
    return true;
}

/// Replaces the triangles that a point is beyond by triangles between it and their border. The
/// surface remains closed, whichever they are.
void InnerPolyhedron::include(const Vec3& p) {
    std::vector<Edge> border;
    const auto beyond = std::partition(
        facets_.begin(), facets_.end(), [&](const Facet& facet) { return !is_beyond(facet, p); });
    for (auto facet = beyond; facet != facets_.end(); ++facet) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Edge edge{facet->corners[i], facet->corners[(i + 1) % 3]};
            const auto back = std::find(border.begin(), border.end(), Edge{edge[1], edge[0]});
            if (back == border.end()) {
                border.push_back(edge);
            } else {
                border.erase(back);
            }
        }
    }
    facets_.erase(beyond, facets_.end());
    for (const Edge& edge : border) {
        add_facet(edge[0], edge[1], p);
    }
}

}  // namespace quasimc

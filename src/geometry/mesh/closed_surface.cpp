#include "geometry/mesh/closed_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace quasimc {

bool is_closed(std::span<const Triangle> triangles) {
    using Corner = std::tuple<double, double, double>;
    constexpr double kSteps = 1e7;
    Bounds bounds;
    for (const Triangle& t : triangles) {
        bounds.include(bounds_of(t));
    }
    const Vec3 origin = bounds.center();
    const double scale = kSteps / bounds.radius();
    const auto corner = [&](const Vec3& p) {
        const Vec3 local = scale * (p - origin);
        return Corner{std::round(local.x), std::round(local.y), std::round(local.z)};
    };
    std::map<std::pair<Corner, Corner>, int> edges;
    for (const Triangle& t : triangles) {
        for (std::size_t i = 0; i < t.size(); ++i) {
            const Corner from = corner(t[i]), to = corner(t[(i + 1) % t.size()]);
            edges[std::minmax(from, to)] += from < to ? 1 : to < from ? -1 : 0;
        }
    }
    return std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

}  // namespace quasimc

#include "stress/near_surfaces.h"

#include <algorithm>
#include <array>
#include <vector>

#include "scene/coplanar.h"
#include "scene/overlap_search.h"

namespace quasimc::stress {
namespace {

constexpr double kNearOfScene = 4e-6;

Triangle moved(const Triangle& t, const Vec3& by) {
    return {t[0] + by, t[1] + by, t[2] + by};
}

Bounds grown(const Bounds& bounds, double by) {
    const Vec3 margin{by, by, by};
    return {bounds.low - margin, bounds.high + margin};
}

/// Whether one lies along the other, nearer than rays tell apart, but not in its plane.
bool are_near(const Triangle& a, const Triangle& b, double size) {
    const bool is_a_smaller = area(a) <= area(b);
    const Triangle& small = is_a_smaller ? a : b;
    const Triangle& large = is_a_smaller ? b : a;
    if (!(area(small) > 0) ||
        !meet(bounds_of(small), grown(bounds_of(large), kNearOfScene * size))) {
        return false;
    }
    const double same = coplanar_tolerance(size_of(bounds_of(small)), size);
    return lies_in_plane(small, large, kNearOfScene * size) && !lies_in_plane(small, large, same) &&
           !lie_apart(small, large);
}

}  // namespace

bool has_near_surfaces(const Scene& scene) {
    const Cell& cell = scene.cell();
    const double size = std::max(
        {size_of(scene.bounds()), cell.along_x ? cell.size_x : 0, cell.along_y ? cell.size_y : 0});
    std::vector<Triangle> all;
    for (std::size_t i = 0; i < scene.triangles().size(); ++i) {
        all.push_back(scene.triangles()[i]);
    }
    for (int x = cell.along_x ? -1 : 0; x <= (cell.along_x ? 1 : 0); ++x) {
        for (int y = cell.along_y ? -1 : 0; y <= (cell.along_y ? 1 : 0); ++y) {
            const Vec3 by{x * cell.size_x, y * cell.size_y, 0};
            for (std::size_t i = 0; i < all.size(); ++i) {
                const Triangle image = moved(all[i], by);
                for (std::size_t k = 0; k < all.size(); ++k) {
                    if ((i != k || x != 0 || y != 0) && are_near(image, all[k], size)) {
                        return true;
                    }
                }
            }
        }
    }
    return false;
}

}  // namespace quasimc::stress

#include "stress/near_surfaces.h"

#include <algorithm>
#include <vector>

#include "scene/overlap/coplanar.h"
#include "scene/overlap/overlap_search.h"

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

/// Whether two triangles are nearer than the resolution of rays, but not coplanar.
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
           !lie_apart(small, large, same);
}

/// All triangles, followed by their periodic copies in the neighbouring cells.
std::vector<Triangle> with_images(const Scene& scene) {
    const Cell& cell = scene.cell();
    const int along_x = cell.along_x ? 1 : 0, along_y = cell.along_y ? 1 : 0;
    std::vector<Triangle> all;
    const auto add_moved = [&](const Vec3& by) {
        for (std::size_t i = 0; i < scene.triangle_count(); ++i) {
            all.push_back(moved(data_of(scene).triangles()[i], by));
        }
    };
    add_moved({});
    for (int x = -along_x; x <= along_x; ++x) {
        for (int y = -along_y; y <= along_y; ++y) {
            if (x != 0 || y != 0) {
                add_moved({x * cell.size_x, y * cell.size_y, 0});
            }
        }
    }
    return all;
}

}  // namespace

bool has_near_surfaces(const Scene& scene) {
    const Cell& cell = scene.cell();
    const double size = std::max(
        {size_of(scene.bounds()), cell.along_x ? cell.size_x : 0, cell.along_y ? cell.size_y : 0});
    const std::vector<Triangle> all = with_images(scene);
    for (std::size_t i = 0; i < scene.triangle_count(); ++i) {
        for (std::size_t k = i + 1; k < all.size(); ++k) {
            if (are_near(all[i], all[k], size)) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace quasimc::stress

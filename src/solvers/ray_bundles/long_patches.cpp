#include "solvers/ray_bundles/long_patches.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/mesh/closed_surface.h"

namespace quasimc {
namespace {

/// Longest edge over height of a long triangle. The true error of stems of rings of triangles is
/// the reported one at a ratio of 10, twice that at 25, and ten times at 100
/// (docs/develop/notebook/ray-bundles.md).
constexpr double kLongTriangle = 12;
/// A patch is long if it exceeds this fraction of its organ's width.
constexpr double kOfWidth = 0.375;
/// Tolerated fractions in long patches: of an organ's area; of all surfaces, in flat organs, and in
/// closed ones such as stems, which exchange little light.
constexpr double kMaxOfOrgan = 0.05, kMaxOfScene = 0.15, kMaxClosed = 0.25;
/// Mean resultant length of the normals from which on an organ is flat: its self view factor is
/// small.
constexpr double kFlat = 0.9;

double longest_edge(const Triangle& t) {
    return std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
}

/// Properties of an organ's shape.
class Shape {
  public:
    /// @param patch  area of a patch
    Shape(const Scene& scene, const Organ& organ, double patch) : area_(organ.area) {
        for (std::size_t i = 0; i < organ.triangle_count; ++i) {
            const Triangle t = data_of(scene).triangles()[organ.first_triangle + i];
            bounds_.include(bounds_of(t));
            normals_ += 0.5 * area_vector(t);
            const double own = area(t);
            of_triangles_ += own;
            const double edge = longest_edge(t);
            if (own > 0 && edge * edge > 2 * kLongTriangle * own) {
                long_.push_back({std::ldexp(edge, -patch_level(own, patch)), own});
            }
        }
    }

    [[nodiscard]] bool has_long_patches() const {
        // Area over length: the circumference of a stem.
        const double most = kOfWidth * area_ / (2 * bounds_.radius());
        double in_long = 0;
        for (const Long& part : long_) {
            in_long += part.patch > most ? part.area : 0;
        }
        return in_long > kMaxOfOrgan * area_;
    }
    [[nodiscard]] bool is_flat() const { return length(normals_) >= kFlat * of_triangles_; }

  private:
    /// A long triangle.
    struct Long {
        double patch = 0;  ///< length of its patches
        double area = 0;
    };
    double area_, of_triangles_ = 0;
    Bounds bounds_;
    Vec3 normals_;  // of all triangles, as long as these are large
    std::vector<Long> long_;
};

}  // namespace

LongPatches find_long_patches(const Scene& scene, const PatchSize& size) {
    std::vector<const Organ*> found, flat, closed;
    double in_flat = 0, in_closed = 0;
    for (const Organ& organ : scene.organs()) {
        const Shape shape(scene, organ, size.part * size.area);
        if (!(organ.area > 0) || !shape.has_long_patches()) {
            continue;
        }
        if (shape.is_flat()) {
            flat.push_back(&organ);
            in_flat += organ.area;
        } else if (is_closed(scene.triangles_of(organ))) {
            closed.push_back(&organ);
            in_closed += organ.area;
        } else {
            found.push_back(&organ);
        }
    }
    if (in_flat > kMaxOfScene * size.area) {
        found.insert(found.end(), flat.begin(), flat.end());
    }
    if (in_closed > kMaxClosed * size.area) {
        found.insert(found.end(), closed.begin(), closed.end());
    }
    return {std::move(found), in_closed / size.area};
}

}  // namespace quasimc

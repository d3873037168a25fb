#include "solvers/long_patches.h"

#include <algorithm>
#include <cmath>

#include "scene/lint.h"
#include "solvers/bundle_budget.h"
#include "solvers/patch_size.h"

namespace quasimc {
namespace {

/// Longest edge over height. Stems of rings of triangles with a ratio of 10 have the error that is
/// told, with one of 25 twice that, with one of 100 ten times (docs/theory/ray-bundles.md).
constexpr double kLongTriangle = 12;
/// A patch is long beside its organ's width if it is longer than this part of it.
constexpr double kOfWidth = 0.75;
/// Of an organ's area, what may lie in long patches; of all surfaces, what may lie in flat organs
/// that have them: what goes to and fro between these is little.
constexpr double kMostOfOrgan = 0.05, kMostOfScene = 0.15;
/// Organs of which the normals agree so well are flat: they send themselves next to no light.
constexpr double kFlat = 0.9;

double longest_edge(const Triangle& t) {
    return std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
}

/// Area over length. Of a stem this is its circumference.
double width_of(const Scene& scene, const Organ& organ) {
    Bounds bounds;
    for (std::size_t i = 0; i < organ.triangle_count; ++i) {
        for (const Vec3& corner : scene.triangles()[organ.first_triangle + i]) {
            bounds.add(corner);
        }
    }
    return organ.area / (2 * bounds.radius());
}

bool is_flat(const Scene& scene, const Organ& organ) {
    Vec3 sum;
    double lengths = 0;
    for (std::size_t i = 0; i < organ.triangle_count; ++i) {
        const Vec3 own = area_vector(scene.triangles()[organ.first_triangle + i]);
        sum += own;
        lengths += length(own);
    }
    return length(sum) >= kFlat * lengths;
}

/// @param patch  the area that patches have
bool has_long_patches(const Scene& scene, const Organ& organ, double patch) {
    const double most = kOfWidth * width_of(scene, organ);
    double in_long = 0;
    for (std::size_t i = 0; i < organ.triangle_count; ++i) {
        const Triangle t = scene.triangles()[organ.first_triangle + i];
        const double edge = longest_edge(t);
        const double own = area(t);
        const bool is_long = edge * edge > 2 * kLongTriangle * own && own > 0 &&
                             std::ldexp(edge, -patch_level(own, patch)) > most;
        in_long += is_long ? own : 0;
    }
    return in_long > kMostOfOrgan * organ.area;
}

/// Those that matter.
std::vector<const Organ*> organs_of_long_patches(const Scene& scene, std::uint64_t paths) {
    double all = 0;
    for (const Organ& organ : scene.organs()) {
        all += organ.area;
    }
    const double patch = all * patch_size(scene, patches_for(paths)).part;
    std::vector<const Organ*> bodies, flat;
    double in_flat = 0;
    for (const Organ& organ : scene.organs()) {
        if (organ.area > 0 && has_long_patches(scene, organ, patch)) {
            const bool is_even = is_flat(scene, organ);
            (is_even ? flat : bodies).push_back(&organ);
            in_flat += is_even ? organ.area : 0;
        }
    }
    if (in_flat > kMostOfScene * all) {
        bodies.insert(bodies.end(), flat.begin(), flat.end());
    }
    return bodies;
}

}  // namespace

bool has_long_patches(const Scene& scene, std::uint64_t paths) {
    return !organs_of_long_patches(scene, paths).empty();
}

std::vector<Warning> lint_bundles(const Scene& scene, const RunSpec& spec) {
    WarningKind found("organs are of long thin triangles");
    if (spec.method == Method::ray_bundles) {
        for (const Organ* organ : organs_of_long_patches(scene, spec.paths)) {
            found.add(
                words_for(*organ),
                "is of long thin triangles: ray_bundles takes light as even along patches that are "
                "longer than it is wide, and its errors don't tell what is wrong with that; cut "
                "them into shorter ones, or use method = \"first_hits\"");
        }
    }
    return std::move(found).finish();
}

}  // namespace quasimc

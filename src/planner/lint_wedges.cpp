#include "planner/lint_wedges.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "planner/near_lamp.h"
#include "scene/lint.h"
#include "scene/overlap/coplanar.h"
#include "scene/overlap/overlap_search.h"

namespace quasimc {
namespace {

constexpr double kNextTo = 1e-4;  ///< fraction of the scene size
constexpr double kNarrow = 0.1;   ///< distance of the sides of a wedge over its length

Vec3 closest_on_edge(const Vec3& from, const Vec3& to, const Vec3& point) {
    const Vec3 along = to - from;
    const double square = dot(along, along);
    const double t = square > 0 ? dot(point - from, along) / square : 0;
    return from + std::clamp(t, 0.0, 1.0) * along;
}

/// The point on a triangle that is closest to `point`.
Vec3 closest_point(const Triangle& t, const Vec3& point) {
    const Vec3 across = area_vector(t);
    const Vec3 foot = point - dot(point - t[0], across) / dot(across, across) * across;
    Vec3 closest = foot;
    double least = std::numeric_limits<double>::infinity();
    bool is_inside = dot(across, across) > 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
        const Vec3& next = t[(i + 1) % t.size()];
        is_inside = is_inside && dot(cross(next - t[i], foot - t[i]), across) >= 0;
        const Vec3 on_edge = closest_on_edge(t[i], next, point);
        if (length(on_edge - point) < least) {
            least = length(on_edge - point);
            closest = on_edge;
        }
    }
    return is_inside ? foot : closest;
}

/// Whether a triangle that touches another next to `point` runs along it from there.
bool runs_along(const Triangle& a, const Triangle& b, const Vec3& point, double reach) {
    const auto is_next_to_b = [&](const Vec3& p) {
        return length(closest_point(b, p) - p) <= kNarrow * reach;
    };
    const Vec3 touching = closest_point(a, point);
    const Vec3 inwards = (1.0 / 3) * (a[0] + a[1] + a[2]) - touching;
    return length(inwards) > reach && is_next_to_b(touching) &&
           is_next_to_b(touching + reach / length(inwards) * inwards);
}

/// Whether two triangles, not in one plane, make a narrow wedge next to `point`.
bool has_wedge(const Scene& scene, const Vec3& point, double size) {
    const double reach = kNextTo * size;
    std::vector<Triangle> near;
    for (std::size_t i = 0; i < scene.triangle_count(); ++i) {
        const Triangle& t = data_of(scene).triangles()[i];
        const Bounds box = bounds_of(t);
        const Vec3 margin{reach, reach, reach};
        if (meet({point, point}, {box.low - margin, box.high + margin}) &&
            length(closest_point(t, point) - point) <= reach) {
            near.push_back(t);
        }
    }
    for (const Triangle& a : near) {
        for (const Triangle& b : near) {
            const double same = coplanar_tolerance(size_of(bounds_of(a)), size);
            if (&a != &b && area(b) > 0 && !lies_in_plane(a, b, same) &&
                runs_along(a, b, point, reach)) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

std::vector<Warning> lint_wedges(const Scene& scene, const Sources& sources) {
    WarningKind found(
        "lamp is close to a narrow wedge between surfaces",
        "lamps are close to narrow wedges between surfaces");
    for (const auto& source : sources) {
        const std::optional<Vec3> point = position_of_lamp(*source, scene.bounds());
        if (point && has_wedge(scene, *point, size_of(scene.bounds()))) {
            found.add(
                "source '" + source->name() + "'",
                "is a lamp within 1e-4 of the scene's size of a narrow wedge between surfaces; "
                "results can be wrong there by more than their errors say; move it away");
        }
    }
    return std::move(found).finish();
}

}  // namespace quasimc

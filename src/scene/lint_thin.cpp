// Warnings about organs so thin relative to the scene that the single precision of ray tracing
// changes their areas. Corners are rounded here as in the ray tracer.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geometry/mesh/local_mesh.h"
#include "scene/lint.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

/// Sums of the squared changes of area vectors by rounding, and of the lengths of these vectors.
struct Blur {
    double squares = 0, lengths = 0;

    /// Relative error of the area.
    [[nodiscard]] double part() const { return lengths > 0 ? std::sqrt(squares) / lengths : 0; }
};

Blur blur_of(const Scene& scene, const Organ& organ, const Bounds& bounds, double scale) {
    const auto rounded = [&](const Vec3& p) {
        const Vec3 local = scale * (p - bounds.center());
        return Vec3{
            static_cast<float>(local.x), static_cast<float>(local.y), static_cast<float>(local.z)};
    };
    const SceneGeometry& triangles = data_of(scene).triangles();
    const std::size_t end = std::size_t{organ.first_triangle} + organ.triangle_count;
    Blur blur;
    // Copies of a mesh are rounded about its own centre.
    for (std::size_t i = organ.first_triangle; i < end && i < triangles.mesh().size(); ++i) {
        const Triangle t = triangles[i];
        const Vec3 exact = scale * scale * area_vector(t);
        const Vec3 off = area_vector({rounded(t[0]), rounded(t[1]), rounded(t[2])}) - exact;
        blur.squares += dot(off, off);
        blur.lengths += length(exact);
    }
    return blur;
}

/// Bounds of the traced scene; of a periodic one, the cell with what extends above and below it.
Bounds traced_bounds(const Survey& survey) {
    Bounds bounds = survey.scene.bounds();
    const Cell& cell = survey.scene.cell();
    const Vec3 center = bounds.center();
    Vec3 half = 0.5 * bounds.size();
    half.x = cell.along_x ? 0.5 * cell.size_x : half.x;
    half.y = cell.along_y ? 0.5 * cell.size_y : half.y;
    Bounds traced;
    traced.add(center - half);
    traced.add(center + half);
    return traced;
}

}  // namespace

std::vector<Warning> lint_thin(const Survey& survey) {
    const Scene& scene = survey.scene;
    const Bounds bounds = traced_bounds(survey);
    const double scale = local_scale(bounds);
    WarningKind thin(
        "organ is too thin compared with the scene", "organs are too thin compared with the scene");
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        const Organ& organ = scene.organs()[i];
        constexpr double kMaxBlur = 0.05;
        const double part = blur_of(scene, organ, bounds, scale).part();
        if (part > kMaxBlur && part_of_scene(survey, i) >= kSmallestPart) {
            thin.add(
                describe_organ(organ),
                fmt::format(
                    "is so thin compared with the scene that rounding to single "
                    "precision changes its area by {:.0f} %; its light is "
                    "corrected for that, but its direction and shadow are not",
                    std::ceil(100 * part)));
        }
    }
    return std::move(thin).finish();
}

}  // namespace quasimc

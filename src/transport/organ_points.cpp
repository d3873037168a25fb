#include "transport/organ_points.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/checks.h"
#include "base/distribution.h"

namespace quasimc {

OrganPoints::OrganPoints(const PreparedScene& prepared) : prepared_(prepared) {
    const Scene& scene = prepared.scene();
    for (const Triangle& triangle : scene.triangles()) {
        area_until_.push_back(area(triangle));
    }
    for (const Organ& organ : scene.organs()) {
        const auto first = area_until_.begin() + organ.first_triangle;
        double sum = 0;
        std::for_each(first, first + organ.triangle_count, [&](double& x) { x = sum += x; });
    }
    const std::uint32_t n = prepared.caster().mesh().triangle_count();
    first_image_.assign(scene.triangles().size() + 1, 0);
    for (std::uint32_t i = 0; i < n; ++i) {
        ++first_image_[prepared.caster().source(i) + 1];
    }
    for (std::size_t i = 1; i < first_image_.size(); ++i) {
        first_image_[i] += first_image_[i - 1];
    }
    images_.resize(n);
    std::vector<std::uint32_t> next(first_image_.begin(), first_image_.end() - 1);
    for (std::uint32_t i = 0; i < n; ++i) {
        images_[next[prepared.caster().source(i)]++] = i;
    }
}

OrganPoint OrganPoints::place(std::size_t organ_index, double u0, double u1) const {
    const Organ& organ = prepared_.scene().organs()[organ_index];
    EXPECT(organ.area > 0);
    const IntervalPick pick = pick_interval(
        std::span(area_until_).subspan(organ.first_triangle, organ.triangle_count),
        u0 * organ.area);
    const double root = std::sqrt(pick.part);
    const auto triangle = organ.first_triangle + static_cast<std::uint32_t>(pick.index);
    return on_triangle(triangle, root * (1 - u1), root * u1);
}

OrganPoint OrganPoints::on_triangle(std::uint32_t scene_triangle, double u, double v) const {
    const LocalMesh& mesh = prepared_.caster().mesh();
    const std::uint32_t first = first_image_[scene_triangle];
    const std::uint32_t last = first_image_[scene_triangle + 1];
    std::uint32_t triangle = images_[first];
    for (std::uint32_t i = first; i < last && last - first > 1; ++i) {
        if (in_cell(mesh.point(images_[i], u, v))) {
            triangle = images_[i];
            break;
        }
    }
    const Vec3 a = mesh.vertex(triangle, 0);
    const Vec3 up = cross(mesh.vertex(triangle, 1) - a, mesh.vertex(triangle, 2) - a);
    return {mesh.point(triangle, u, v), normalized(up), triangle, prepared_.region(triangle)};
}

bool OrganPoints::in_cell(const Vec3& local) const {
    const Cell& cell = prepared_.scene().cell();
    const LocalMesh& mesh = prepared_.caster().mesh();
    const Vec3 p = mesh.to_world(local);
    return !(cell.along_x && (p.x < cell.low_x || p.x >= cell.low_x + cell.size_x)) &&
           !(cell.along_y && (p.y < cell.low_y || p.y >= cell.low_y + cell.size_y));
}

}  // namespace quasimc

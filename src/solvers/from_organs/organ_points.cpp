#include "solvers/from_organs/organ_points.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/checks.h"
#include "base/distribution.h"
#include "optics/turn.h"
#include "scene/scene.h"

namespace quasimc {

OrganPoints::OrganPoints(const PreparedScene& prepared)
    : prepared_(prepared), sensors_(data_of(prepared.scene()).sensors.get()) {
    if (sensors_ != nullptr) {
        start_sensors();
        return;
    }
    areas_ = &organ_areas(prepared.scene());
    if (!prepared.caster().has_own_numbers()) {
        list_images();
    }
}

void OrganPoints::list_images() {
    const RayCaster& caster = prepared_.caster();
    const std::uint32_t n = caster.mesh().triangle_count();
    first_image_.assign(prepared_.scene().triangle_count() + 1, 0);
    for (std::uint32_t i = 0; i < n; ++i) {
        ++first_image_[caster.source(i) + 1];
    }
    for (std::size_t i = 1; i < first_image_.size(); ++i) {
        first_image_[i] += first_image_[i - 1];
    }
    images_.resize(n);
    std::vector<std::uint32_t> next(first_image_.begin(), first_image_.end() - 1);
    for (std::uint32_t i = 0; i < n; ++i) {
        images_[next[caster.source(i)]++] = i;
    }
}

double OrganPoints::open_part(const Organ& organ) {
    return organ.area > 0 ? std::max(0.0, 1 - organ.covered_area / organ.area) : 0;
}

OrganPoint OrganPoints::point(std::size_t organ_index, double u0, double u1) const {
    if (sensors_ != nullptr) {
        return on_sensor(organ_index, u0, u1);
    }
    const Organ& organ = prepared_.scene().organs()[organ_index];
    EXPECT(organ.area > organ.covered_area);
    const OrganAreas::Pick pick = areas_->pick(organ, u0 * (organ.area - organ.covered_area));
    const double root = std::sqrt(pick.fraction);
    return on_triangle(pick.triangle, root * (1 - u1), root * u1);
}

/// Sensors on a surface are lifted by rounding, so that its light, or its shadow, does not depend
/// on chance.
void OrganPoints::start_sensors() {
    constexpr double kLift = 2e-6;
    const LocalMesh& mesh = prepared_.caster().mesh();
    for (const SensorDisks& sensor : sensors_->disks) {
        std::vector<Vec3>& centers = centers_.emplace_back();
        for (const SensorDisk& disk : sensor.disks) {
            const Vec3 center = mesh.to_local(disk.center);
            const Vec3 lifted = center + kLift * disk.up;
            const CastHit below = prepared_.caster().cast(lifted, -disk.up, kNoTriangle);
            const bool is_on = below.end == RayEnd::hit && below.hit.t <= 2 * kLift;
            centers.push_back(is_on ? lifted : center);
        }
    }
}

/// A point of one of a sensor's disks.
OrganPoint OrganPoints::on_sensor(std::size_t organ_index, double u0, double u1) const {
    const std::size_t row = organ_index - sensors_->first;
    const SensorDisks& sensor = sensors_->disks[row];
    const double pick = u0 * static_cast<double>(sensor.disks.size());
    const std::size_t index = std::min(static_cast<std::size_t>(pick), sensor.disks.size() - 1);
    const Vec3& up = sensor.disks[index].up;
    Vec3 p = centers_[row][index];
    if (sensor.radius > 0) {
        const Frame frame = frame_about(up);
        const double radius = std::sqrt(pick - static_cast<double>(index)) * sensor.radius;
        const SinCos angle = sin_cos_turn(u1);
        p += prepared_.caster().mesh().scale * radius * (angle.cos * frame.s + angle.sin * frame.t);
    }
    const Organ& organ = prepared_.scene().organs()[organ_index];
    return {p, up, kNoTriangle, organ.first_region, sensor.receiver};
}

OrganPoint OrganPoints::on_triangle(std::uint32_t scene_triangle, double u, double v) const {
    const LocalMesh& mesh = prepared_.caster().mesh();
    const std::uint32_t triangle =
        first_image_.empty() ? scene_triangle : image_at(scene_triangle, u, v);
    return {
        mesh.point(triangle, u, v), normalized(across(scene_triangle, triangle)), triangle,
        prepared_.region(triangle)};
}

/// The normal of a triangle's upper side: of its rounded corners, or as given if rounding turns it.
Vec3 OrganPoints::across(std::uint32_t scene_triangle, std::uint32_t mesh_triangle) const {
    constexpr double kLeast = 1e-5;
    const LocalMesh& mesh = prepared_.caster().mesh();
    const Vec3 rounded = mesh.exact_across(mesh_triangle);
    const Vec3 given = mesh.scale * mesh.scale *
                       area_vector(data_of(prepared_.scene()).triangles()[scene_triangle]);
    const Vec3 off = given - rounded;
    const bool is_turned = dot(off, off) > kLeast * kLeast * dot(given, given);
    return is_turned && dot(given, given) > 0 ? given : rounded;
}

/// The image of a triangle that has the point (u, v) in the cell.
std::uint32_t OrganPoints::image_at(std::uint32_t scene_triangle, double u, double v) const {
    const LocalMesh& mesh = prepared_.caster().mesh();
    const std::uint32_t first = first_image_[scene_triangle];
    const std::uint32_t last = first_image_[scene_triangle + 1];
    for (std::uint32_t i = first; i < last && last - first > 1; ++i) {
        if (in_cell(mesh.point(images_[i], u, v))) {
            return images_[i];
        }
    }
    return images_[first];
}

bool OrganPoints::in_cell(const Vec3& local) const {
    const Cell& cell = prepared_.scene().cell();
    const LocalMesh& mesh = prepared_.caster().mesh();
    const Vec3 p = mesh.to_world(local);
    return !(cell.along_x && (p.x < cell.low_x || p.x >= cell.low_x + cell.size_x)) &&
           !(cell.along_y && (p.y < cell.low_y || p.y >= cell.low_y + cell.size_y));
}

}  // namespace quasimc

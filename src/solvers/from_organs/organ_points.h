#pragma once

#include <cstdint>
#include <vector>

#include "scene/organ_areas.h"
#include "scene/sensors.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// A point of an organ or a sensor, local coordinates.
struct OrganPoint {
    Vec3 p;
    Vec3 up;                     ///< unit normal of the upper side
    std::uint32_t triangle = 0;  ///< index in the mesh; kNoTriangle: a sensor
    std::uint32_t region = 0;
    Receiver receiver = Receiver::cosine;

    [[nodiscard]] bool is_sensor() const { return triangle == kNoTriangle; }
};

/// Samples points on organs, uniformly over the area that other organs do not cover, and on the
/// disks of sensors.
class OrganPoints {
  public:
    explicit OrganPoints(const PreparedScene& prepared);

    /// The fraction of an organ's area that is not covered (Organ::covered_area); 0 without area.
    [[nodiscard]] static double open_part(const Organ& organ);
    /// The point of an organ (of which some part is open) for a point of the unit square: u0 picks
    /// the triangle and is used again inside it. Periodic scenes: on that image of the triangle
    /// which has the point in the cell.
    [[nodiscard]] OrganPoint point(std::size_t organ, double u0, double u1) const;

  private:
    void list_images();
    void start_sensors();
    [[nodiscard]] OrganPoint on_sensor(std::size_t organ, double u0, double u1) const;
    [[nodiscard]] OrganPoint on_triangle(std::uint32_t scene_triangle, double u, double v) const;
    [[nodiscard]] Vec3 across(std::uint32_t scene_triangle, std::uint32_t mesh_triangle) const;
    [[nodiscard]] std::uint32_t image_at(std::uint32_t scene_triangle, double u, double v) const;
    [[nodiscard]] bool in_cell(const Vec3& local) const;

    const PreparedScene& prepared_;
    const SensorOrgans* sensors_;             // null: none
    std::vector<std::vector<Vec3>> centers_;  // of the disks of each sensor, local coordinates
    const OrganAreas* areas_ = nullptr;       // null if only sensors are measured
    // The mesh triangles that are images of scene triangle i: [first_image_[i], first_image_[i +
    // 1]). Empty if the mesh has the scene's own numbers.
    std::vector<std::uint32_t> first_image_, images_;
};

}  // namespace quasimc

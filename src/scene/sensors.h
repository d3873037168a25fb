#pragma once

// Sensors: their checks, and the scenes by which their light is computed and read.

#include <cstdint>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/scene.h"
#include "scene/scene.h"

namespace quasimc {

/// Adds the faults of sensors: no points, positions that are not finite, names of other sensors.
/// Returns them complete: z up, every point with a name and a facing of length 1.
[[nodiscard]] std::vector<SensorSet> check_sensors(
    std::vector<SensorSet> sensors, const Orientation& orientation, Faults& faults);

/// A disk that receives light.
struct SensorDisk {
    Vec3 center, up;
};

/// The disks of a result: one, or all over which it is a mean.
struct SensorDisks {
    std::vector<SensorDisk> disks;  ///< not empty
    double radius = 0;              ///< the same for all
    Receiver receiver = Receiver::cosine;
};

/// The organs of a scene that are sensors, without triangles: the last ones.
struct SensorOrgans {
    std::size_t first = 0;           ///< index of the first in the list of organs
    std::vector<SensorDisks> disks;  ///< one entry for each
};

/// Returns the scene in which light on sensors is computed. Its organs are the former ones as one,
/// and the ground if there is one, neither of them measured; then the sensors. Its regions are as
/// few. It shares the triangles, and has no detectors.
/// @param scene  with sensors
[[nodiscard]] Scene scene_with_sensors(const Scene& scene);

/// Returns the scene whose organs are the results of sensors alone: bands, names and labels, with
/// an area of 1. It has no triangles of them.
[[nodiscard]] Scene scene_of_sensors(const Scene& scene);

/// Returns the scene with other sensors.
/// @param sensors  complete, as those of a scene
[[nodiscard]] Scene scene_with_other_sensors(const Scene& scene, std::vector<SensorSet> sensors);

/// The position of each result, z up: of its point, or the mean of several.
[[nodiscard]] std::vector<Vec3> sensor_positions(const Scene& scene);

/// By result, whether the sensor is a sphere.
[[nodiscard]] std::vector<bool> spheres_of(const Scene& scene);

/// The number of results of sensors.
[[nodiscard]] std::size_t sensor_rows(const Scene& scene);

/// Whether an organ is a sensor of scene_with_sensors().
[[nodiscard]] inline bool is_point_sensor(const Organ& organ) {
    return organ.triangle_count == 0 && organ.area > 0;
}

}  // namespace quasimc

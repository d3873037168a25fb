#pragma once

// The light on sensors: a run of its own, by paths from the sensors, after that of the organs.

#include "quasimc/result.h"
#include "quasimc/run_spec.h"
#include "quasimc/source.h"
#include "scene/scene.h"

namespace quasimc {

/// Whether a scene has sensors (SceneBuilder::add_sensors()).
[[nodiscard]] bool has_sensors(const Scene& scene);

/// Adds the faults of sensors whose light cannot be computed: below lamps that repeat with the
/// cell, or where mirrors reflect or transmit light of suns and lamps.
void check_sensor_light(const Scene& scene, const Sources& sources, Faults& faults);

/// The specification of the run of the organs: without a target that is for sensors alone.
[[nodiscard]] RunSpec spec_of_organs(const Scene& scene, const RunSpec& spec);

/// The specification of the run of the sensors of a scene: from_organs, with the paths of the run
/// divided among the sensors, or 32 points (or all paths, if fewer) for each if that is more.
[[nodiscard]] RunSpec spec_of_sensors(const Scene& scene, const RunSpec& spec);

/// The sensors of the result of scene_with_sensors().
/// @param scene  with the sensors
[[nodiscard]] Result sensors_of(Result all, const Scene& scene);

}  // namespace quasimc

#pragma once

#include "quasimc/run_spec.h"
#include "scene/scene.h"

namespace quasimc {

/// Whether all that scatters light does so by the cosine law, as ray bundles ask.
[[nodiscard]] bool is_diffuse(const Scene& scene);
/// Whether a material does, or is a sensor.
[[nodiscard]] bool is_diffuse(const Material& material);

/// Whether ray bundles find the light of suns and skies with smaller errors for their time than
/// other ways do, where all organs are asked for: rules of thumb, each from a measurement
/// (docs/develop/notebook/choosing.md).
/// @param gain  of equal shares of paths for each organ
/// @param has_sun  whether a sun shines
[[nodiscard]] bool suits_bundles(
    const Scene& scene, const RunSpec& spec, double gain, bool has_sun);

}  // namespace quasimc

#pragma once

#include "quasimc/run_spec.h"
#include "scene/scene.h"

namespace quasimc {

/// Whether all surfaces that scatter light are Lambertian, as ray bundles require.
[[nodiscard]] bool is_diffuse(const Scene& scene);
/// Whether a material is Lambertian, or a sensor.
[[nodiscard]] bool is_diffuse(const Material& material);

/// Whether ray bundles are the most efficient method for light of suns and skies if all organs are
/// measured: rules of thumb, each from a measurement (docs/develop/notebook/choosing.md).
/// @param gain  of equal shares of paths for each organ
/// @param has_sun  whether a sun shines
[[nodiscard]] bool suits_bundles(
    const Scene& scene, const RunSpec& spec, double gain, bool has_sun);

}  // namespace quasimc

#pragma once

#include "quasimc/run_spec.h"
#include "quasimc/source.h"
#include "scene/scene.h"

namespace quasimc {

/// Whether all surfaces that scatter light are Lambertian, as ray bundles require.
[[nodiscard]] bool is_diffuse(const Scene& scene);
/// Whether a material is Lambertian, or a sensor.
[[nodiscard]] bool is_diffuse(const Material& material);

/// Whether ray bundles may be chosen: materials are Lambertian, and patches are neither too many
/// for the memory nor longer or larger than the shadows of organs, an error that replicates share.
[[nodiscard]] bool suits_bundles(const Scene& scene, const Sources& sources, const RunSpec& spec);

}  // namespace quasimc

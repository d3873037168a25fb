// Lambert's cosine law: an ideal diffuse surface.
//
// Model    Light leaves with density |cos(wo, n)| / pi for every direction of incidence: a constant
// BSDF. Paper    Lambert (1760), Photometria. Sampling Malley's method: cos^2 = 1 - u0, azimuth = 2
// pi u1. Theory   docs/theory/leaf-and-soil-models.md
#pragma once

#include <memory>

#include "optics/bsdf.h"

namespace quasimc {

/// The model `lambertian` of the catalogue.
[[nodiscard]] std::unique_ptr<Bsdf> make_lambertian(Hemisphere hemisphere);

}  // namespace quasimc

// The Blinn-Phong lobe: a power of the cosine of half the angle to the specular direction.
//
// Model    p = (n + 2) / (8 pi) cos^n(theta / 2) over the whole sphere about the mirror direction
//          (reflected) or the unchanged direction (transmitted). Light on the wrong side
//          is mirrored at the surface: pdf(wo) = p(wo) + p(image of wo), with integral 1 for
//          any angle of incidence. Symmetric, but the BSDF is not reciprocal.
// Papers   Blinn (1977), SIGGRAPH '77, 192-198. Shirley and Wang (1992). Mech (1997), thesis.
// Sampling cos(theta / 2) = (1 - u0)^(1 / (n + 2)), azimuth = 2 pi u1.
// Theory   docs/theory/leaf-and-soil-models.md
#pragma once

#include <memory>

#include "optics/bsdf.h"

namespace quasimc {

/// The model `blinn_phong` of the catalogue, of an exponent in 0 ... kMaxExponent.
[[nodiscard]] std::unique_ptr<Bsdf> make_blinn_phong(Hemisphere hemisphere, double exponent);

}  // namespace quasimc

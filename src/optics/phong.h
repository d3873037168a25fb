// Phong's lobe: a power of the cosine of the angle to the specular direction.
//
// Model    p = (n + 1) / (2 pi) cos^n(theta) for theta <= 90 degrees about the mirror direction
//          (reflected) or the unchanged direction (transmitted). Light on the wrong side
//          is mirrored at the surface: pdf(wo) = p(wo) + p(image of wo), with integral 1 for
//          any angle of incidence. Symmetric, but the BSDF is not reciprocal.
// Papers   Phong (1975), CACM 18(6), 311-317. Lafortune and Willems (1994), report CW 197: density,
//          sampling.
// Sampling cos = (1 - u0)^(1 / (n + 1)), azimuth = 2 pi u1.
// Theory   docs/theory/leaf-and-soil-models.md
#pragma once

#include <memory>

#include "optics/bsdf.h"

namespace quasimc {

/// The model `phong` of the catalogue, of an exponent in 0 ... kMaxExponent.
[[nodiscard]] std::unique_ptr<Bsdf> make_phong(Hemisphere hemisphere, double exponent);

}  // namespace quasimc

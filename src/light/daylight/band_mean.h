#pragma once

#include "light/daylight/spectrum.h"

namespace quasimc {

/// The mean of a property of a surface over a band, weighted by the light in the band's unit:
/// integral of property x light over integral of light. Exact, as both are piecewise linear.
/// Without light in the band, the mean over wavelengths.
/// @param property  reflectance or transmittance by wavelength; must cover the band
[[nodiscard]] double band_mean(
    const Spectrum& property, const Spectrum& light, const SpectralSpan& span);

}  // namespace quasimc

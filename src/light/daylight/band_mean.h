#pragma once

#include "light/daylight/spectrum.h"

namespace quasimc {

/// The mean of a property of a surface over a band, weighted by what the band counts of the light:
/// integral of property x light over integral of light. Exact, as both are linear between their
/// points. Where the light has nothing in the band, the mean over wavelengths.
/// @param property  reflectance or transmittance by wavelength; it must reach over the band
[[nodiscard]] double band_mean(
    const Spectrum& property, const Spectrum& light, const SpectralSpan& span);

}  // namespace quasimc

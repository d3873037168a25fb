#pragma once

#include "light/daylight/spectrum.h"

namespace quasimc {

/// The reference spectra of ASTM G173-03 (air mass 1.5; NREL, computed with SMARTS 2.9.2): on a
/// plane tilted by 37 degrees towards the sun, and of the sun with the sky around it on a plane
/// that faces it. All 2,002 points of the table, the same for both; integrals over 280 to 4000 nm:
/// 1000.4 and 900.1 W m-2.
[[nodiscard]] const Spectrum& reference_global();
[[nodiscard]] const Spectrum& reference_direct();

/// A measured spectrum, continued beyond its ends by a reference spectrum, scaled to the same
/// energy over the measured wavelengths. Beyond an end with value 0 there is no light.
/// @param measured  has wavelengths in common with the reference
[[nodiscard]] Spectrum continued(const Spectrum& measured, const Spectrum& reference);

}  // namespace quasimc

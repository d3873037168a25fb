#pragma once

#include "quasimc/sources/spectrum.h"

namespace quasimc {

/// The reference spectra of ASTM G173-03 (air mass 1.5; NREL, computed with SMARTS 2.9.2): on a
/// plane tilted by 37 degrees towards the sun, and of the sun with the sky around it on a plane
/// that faces it. 679 of the 2002 points: every 2 nm from 300 to 398, every 1 nm to 770, every 5 nm
/// to 1700, every 10 to 100 nm to 4000. Integrals over 280 to 4000 nm: 1002.8 and 902.5 W m-2, of
/// the whole table 1000.4 and 900.1.
[[nodiscard]] const Spectrum& reference_global();
[[nodiscard]] const Spectrum& reference_direct();

}  // namespace quasimc

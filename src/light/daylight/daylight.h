#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "light/daylight/spectrum.h"
#include "quasimc/source.h"

namespace quasimc {

/// Unit of an amount of daylight.
enum class LightUnit {
    full_spectrum,  ///< W m-2, 280 to 4000 nm
    par,            ///< W m-2, 400 to 700 nm
    ppfd,           ///< umol m-2 s-1, 400 to 700 nm
    lux             ///< lx
};
[[nodiscard]] SpectralSpan span_of(LightUnit unit);

/// Turns daylight into irradiances of bands, and amounts of any unit into daylight.
///
/// By default direct light has the direct spectrum of ASTM G173-03, and direct and diffuse light
/// together the global one, in any proportion. Sky light is their difference: blue under a clear
/// sky, like global light under clouds. No sky is bluer than that of the standard itself (diffuse
/// fraction 0.117, from its tilted plane). User-defined spectra replace both.
class DaylightSpectra {
  public:
    DaylightSpectra();
    /// Wavelengths that the spectra do not cover have no light: see continued().
    DaylightSpectra(Spectrum direct, Spectrum diffuse);

    /// Direct light of 1 W m-2 (full spectrum) in a span.
    [[nodiscard]] double direct(const SpectralSpan& span) const;
    /// The light of the sky of `light` in a span.
    [[nodiscard]] double diffuse(const SpectralSpan& span, const Daylight& light) const;

    /// Daylight from amounts on the horizontal.
    [[nodiscard]] Daylight from_parts(double direct, double diffuse, LightUnit unit) const;
    /// Global light in W m-2, full spectrum, from an amount. User-defined spectra: as if half of it
    /// came from the sky.
    [[nodiscard]] double from_global(double amount, LightUnit unit) const;
    /// Daylight with a diffuse fraction (full spectrum) and an amount of global light.
    [[nodiscard]] Daylight from_fraction(double amount, LightUnit unit, double fraction) const;

  private:
    /// Irradiance in a span, for a full spectrum of 1 W m-2.
    [[nodiscard]] double share(const Spectrum& spectrum, const SpectralSpan& span) const;

    Spectrum direct_;
    Spectrum sky_;                   // of clear sky, or the user's
    std::optional<Spectrum> whole_;  // of direct and sky together; none with the user's
    double clearest_ = 0;            // diffuse fraction of the clear sky's spectrum
};

/// The wavelengths of a band: its own, or those that its name has ("PAR", "red", "far_red", "NIR",
/// "blue", "green", "UV"; any case and the short forms R, FR, B, G too); nothing for other names.
/// @param from_nm, to_nm  its own; to_nm 0: not given
[[nodiscard]] std::optional<SpectralSpan> span_of_band(
    std::string_view name, double from_nm = 0, double to_nm = 0);

}  // namespace quasimc

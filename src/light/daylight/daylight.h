#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "light/daylight/spectrum.h"
#include "quasimc/source.h"

namespace quasimc {

/// What an amount of daylight counts.
enum class LightUnit {
    full_spectrum,  ///< W m-2, 280 to 4000 nm
    par,            ///< W m-2, 400 to 700 nm
    ppfd,           ///< umol m-2 s-1, 400 to 700 nm
    lux             ///< lx
};
[[nodiscard]] SpectralSpan span_of(LightUnit unit);

/// Turns daylight into irradiances of bands, and amounts of any unit into daylight.
///
/// By default direct light has the direct spectrum of ASTM G173-03 and both together the global
/// one, whatever their shares; so the light of the sky is the rest: blue under a clear sky, like
/// global light under clouds. No sky is bluer than the one of the standard itself (diffuse fraction
/// 0.117, from its tilted plane). With spectra of one's own, direct and diffuse light have these.
class DaylightSpectra {
  public:
    DaylightSpectra();
    /// What the spectra do not cover is dark: see continued().
    DaylightSpectra(Spectrum direct, Spectrum diffuse);

    /// Direct light of 1 W m-2 (full spectrum) in a span.
    [[nodiscard]] double direct(const SpectralSpan& span) const;
    /// The light of the sky of `light` in a span.
    [[nodiscard]] double diffuse(const SpectralSpan& span, const Daylight& light) const;

    /// Daylight from amounts on the horizontal.
    [[nodiscard]] Daylight from_parts(double direct, double diffuse, LightUnit unit) const;
    /// Global light in W m-2, full spectrum, from an amount. (With spectra of one's own: as if half
    /// of it came from the sky.)
    [[nodiscard]] double from_global(double amount, LightUnit unit) const;
    /// Daylight of that diffuse fraction (full spectrum) and amount of global light.
    [[nodiscard]] Daylight from_fraction(double amount, LightUnit unit, double fraction) const;

  private:
    /// In a span, for a full spectrum of 1 W m-2.
    [[nodiscard]] double share(const Spectrum& spectrum, const SpectralSpan& span) const;

    Spectrum direct_;
    Spectrum sky_;                   // of clear sky, or the user's
    std::optional<Spectrum> whole_;  // of direct and sky together; none with the user's
    double clearest_ = 0;            // diffuse fraction of the clear sky's spectrum
};

/// The band that a name stands for ("PAR", "red", "far_red", "NIR", "blue", "green", "UV"; case and
/// the short forms R, FR, B, G too); nothing for other names.
[[nodiscard]] std::optional<SpectralSpan> span_of_band(std::string_view name);

}  // namespace quasimc

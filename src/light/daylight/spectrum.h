#pragma once

#include <array>
#include <vector>

namespace quasimc {

/// A part of the spectrum in nanometres, and the unit that it is counted in.
struct SpectralSpan {
    double from_nm = 0, to_nm = 0;
    enum class Count {
        energy,   ///< W m-2
        photons,  ///< umol m-2 s-1
        lumens    ///< lx: weighted by the photopic curve V of CIE 018:2019
    };
    Count count = Count::energy;
};

/// Irradiance per wavelength [W m-2 nm-1], linear between the points given and 0 outside.
class Spectrum {
  public:
    /// @param nm      ascending
    /// @param values  0 or more, one per wavelength
    Spectrum(std::vector<double> nm, std::vector<double> values);

    [[nodiscard]] double at(double nm) const;
    /// The light in the span, in its unit. Exact, since V is piecewise linear too.
    [[nodiscard]] double within(const SpectralSpan& span) const;
    /// The wavelengths of the points.
    [[nodiscard]] const std::vector<double>& wavelengths() const { return nm_; }
    [[nodiscard]] double low_nm() const { return nm_.front(); }
    [[nodiscard]] double high_nm() const { return nm_.back(); }

  private:
    /// Cumulative light from the low end up to each of some wavelengths.
    struct Integral {
        std::vector<double> nm, until;
    };
    [[nodiscard]] Integral make_integral(SpectralSpan::Count count) const;
    /// The light between two wavelengths with no point of the spectrum between them.
    [[nodiscard]] double piece(SpectralSpan::Count count, double from_nm, double to_nm) const;

    std::vector<double> nm_, values_;
    std::array<Integral, 3> integrals_;  // by count
};

/// umol s-1 of photons in a watt of one wavelength: lambda / (h c N_A) (SI 2019: 8.359347e-3 per
/// nanometre).
[[nodiscard]] double photons_per_joule(double nm);

/// The photopic luminous efficiency V (CIE 1924, tabulated every 10 nm in CIE 018:2019, linear
/// between), 0 outside 380 to 780 nm. 683 V lumens are a watt.
[[nodiscard]] double photopic_efficiency(double nm);

}  // namespace quasimc

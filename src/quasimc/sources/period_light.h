#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "quasimc/sources/sky_table.h"

namespace quasimc {

/// The light of a period (a day, a season, the time a plant has grown): its skies collapsed into
/// one, and the suns that stood in it. Light that is the same all the time is added once, with its
/// amount for the whole period.
class PeriodLight {
  public:
    /// @param bands  of all spectra
    /// @param azimuths, elevations  cells of the table that sums the skies
    explicit PeriodLight(std::size_t bands, std::size_t azimuths = 96, std::size_t elevations = 48);

    /// @param horizontal_irradiance  per band, on the horizontal; times the sky's duration if sums
    ///     over time are wanted
    void add_sky(const SkyShape& shape, std::span<const double> horizontal_irradiance);
    /// @param to_sun  unit, z up; nothing is added if it is not above the horizon
    /// @param facing_irradiance  per band, on a plane that faces it
    void add_sun(const Vec3& to_sun, std::span<const double> facing_irradiance);

    /// One sky, or one for each band if the skies' spectra differed (each band has then a shape of
    /// its own), and one beam for each sun. Those without light are left out.
    [[nodiscard]] std::vector<std::shared_ptr<const Source>> sources(const std::string& name) const;

  private:
    std::vector<SkySum> skies_;     // by band
    std::vector<double> spectrum_;  // of the first sky
    bool same_spectra_ = true;      // all skies' spectra are proportional to the first
    std::vector<std::shared_ptr<const Source>> suns_;
};

}  // namespace quasimc

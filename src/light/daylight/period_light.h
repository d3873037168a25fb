#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "light/models/sky_table.h"

namespace quasimc {

/// The light of a period (a day, a season, the lifetime of a plant): the cumulative sky and all
/// suns of the period (Robinson and Stone 2004). Constant light is added once, with its amount for
/// the whole period.
class PeriodLight {
  public:
    /// @param bands  number of bands of all spectra
    /// @param azimuths, elevations  cells of the table that sums the skies
    explicit PeriodLight(std::size_t bands, std::size_t azimuths = 96, std::size_t elevations = 48);

    /// @param horizontal_irradiance  per band, on the horizontal; times the sky's duration for sums
    /// over time
    void add_sky(const SkyShape& shape, std::span<const double> horizontal_irradiance);
    /// @param to_sun  unit, z up; ignored if it is not above the horizon
    /// @param facing_irradiance  per band, on a plane facing the sun; times its duration, as above
    void add_sun(const Vec3& to_sun, std::span<const double> facing_irradiance);

    [[nodiscard]] std::size_t suns() const { return suns_.size(); }

    /// All sources times a factor: one sky; two if all spectra are mixtures of two, like those of
    /// daylight; else one with its own shape for each band; and one beam for each sun. Sources
    /// without light are left out. Takes about a millisecond for each sky.
    [[nodiscard]] std::vector<std::shared_ptr<const Source>> sources(
        const std::string& name, double factor = 1) const;

  private:
    struct AddedSky {
        SkyShape shape;
        std::vector<double> spectrum;
    };
    struct AddedSun {
        Vec3 to_sun;
        std::vector<double> spectrum;
    };

    std::size_t bands_, azimuths_, elevations_;
    std::vector<AddedSky> skies_;
    std::vector<AddedSun> suns_;
};

}  // namespace quasimc

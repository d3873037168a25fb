#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "light/models/sky_table.h"

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
    /// @param facing_irradiance  per band, on a plane that faces it; times its duration, as above
    void add_sun(const Vec3& to_sun, std::span<const double> facing_irradiance);

    [[nodiscard]] std::size_t suns() const { return suns_.size(); }

    /// What was added, times a factor. One sky; two if the skies' spectra are mixtures of two, like
    /// those of daylight; else one for each band, which has then a shape of its own. And one beam
    /// for each sun. Those without light are left out. Takes about a millisecond for each sky.
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

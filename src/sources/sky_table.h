#pragma once

#include <cstddef>
#include <vector>

#include "sources/sky.h"

namespace quasimc {

/// Radiance of the upper hemisphere in cells of azimuth and elevation, the same all over a cell.
struct SkyTable {
    std::size_t azimuths = 0, elevations = 0;
    /// [elevation * azimuths + azimuth]. Elevations in equal steps of angle, from the horizon up.
    /// Azimuths in equal steps; the first cell begins at `first_azimuth`.
    std::vector<double> radiance;
    double first_azimuth = 0;  ///< radians, from the x axis towards y
    double turn = 1;  ///< +1: azimuths run from x towards y; -1: the other way, as a compass

    [[nodiscard]] double at(std::size_t azimuth, std::size_t elevation) const {
        return radiance[elevation * azimuths + azimuth];
    }
    /// The radiance of the cell that a direction (unit, z up) points to.
    [[nodiscard]] double towards(const Vec3& to_light) const;
};

[[nodiscard]] SkyShape table_shape(SkyTable table);

/// Skies added up in the cells of one table.
class SkySum {
  public:
    /// @param azimuths, elevations  cells of the table that sums the skies
    explicit SkySum(std::size_t azimuths = 96, std::size_t elevations = 48);

    /// Adds a sky of a shape that brings `horizontal_irradiance` on the horizontal: the mean
    /// Adds a sky of a shape that brings `horizontal_irradiance` on the horizontal: the mean
    /// radiance of each cell counts, from some 18,000 looks at the sky (under 2 ms), and the sum is
    /// exact on the horizontal.
    void add_sky(const SkyShape& shape, double horizontal_irradiance);

    /// Adds `factor` times another sum of as many cells.
    void add(const SkySum& other, double factor);

    /// All skies added so far. Their irradiance on the horizontal is horizontal_irradiance().
    [[nodiscard]] const SkyTable& table() const { return table_; }
    [[nodiscard]] double horizontal_irradiance() const { return horizontal_irradiance_; }

  private:
    SkyTable table_;
    double horizontal_irradiance_ = 0;
};

}  // namespace quasimc

#pragma once

#include <cstddef>

#include "quasimc/source.h"

namespace quasimc {

/// Sum of skies in the cells of one table.
class SkySum {
  public:
    /// @param azimuths, elevations  cells of the table that sums the skies
    explicit SkySum(std::size_t azimuths = 96, std::size_t elevations = 48);

    /// Adds a sky of a shape with `horizontal_irradiance` on the horizontal. The table holds the
    /// mean radiance of each cell, from some 18,000 samples of the sky (under 2 ms); the irradiance
    /// on the horizontal is exact.
    void add_sky(const SkyShape& shape, double horizontal_irradiance);

    /// Adds `factor` times another sum with equal cells.
    void add(const SkySum& other, double factor);

    /// All skies added so far. Their irradiance on the horizontal is horizontal_irradiance().
    [[nodiscard]] const SkyTable& table() const { return table_; }
    [[nodiscard]] double horizontal_irradiance() const { return horizontal_irradiance_; }

  private:
    SkyTable table_;
    double horizontal_irradiance_ = 0;
};

}  // namespace quasimc

#include <algorithm>
#include <cmath>
#include <numbers>

#include "quasimc/base/checks.h"
#include "quasimc/sources/hemisphere.h"
#include "quasimc/sources/sky_table.h"

namespace quasimc {

SkySum::SkySum(std::size_t azimuths, std::size_t elevations) {
    EXPECT(azimuths > 0 && elevations > 0);
    table_.azimuths = azimuths;
    table_.elevations = elevations;
    table_.radiance.assign(azimuths * elevations, 0.0);
}

void SkySum::add_sky(const SkyShape& shape, double horizontal_irradiance) {
    const double scale = horizontal_irradiance / quasimc::horizontal_irradiance(shape);
    HemisphereGrid grid;
    for (std::size_t i = 0; i <= table_.azimuths; ++i) {
        grid.azimuths.push_back(
            2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(table_.azimuths));
    }
    for (std::size_t i = 0; i <= table_.elevations; ++i) {
        grid.sines.push_back(std::sin(
            std::numbers::pi / 2 * static_cast<double>(i) /
            static_cast<double>(table_.elevations)));
    }
    // The mean of a cell is weighted as the horizontal sees it, which keeps the sum exact there.
    const std::vector<double> integrals =
        cell_integrals(grid, [&](const Vec3& d) { return d.z * shape.radiance(d); });
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        const double low = grid.sines[row];
        const double high = grid.sines[row + 1];
        for (std::size_t column = 0; column < grid.columns(); ++column) {
            const std::size_t cell = row * grid.columns() + column;
            const double width = grid.azimuths[column + 1] - grid.azimuths[column];
            table_.radiance[cell] +=
                scale * integrals[cell] / (0.5 * (high - low) * (high + low) * width);
        }
    }
    horizontal_irradiance_ += horizontal_irradiance;
}

}  // namespace quasimc

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/checks.h"
#include "light/models/hemisphere.h"
#include "light/models/sky_table.h"

namespace quasimc {
namespace {

/// Number of samples along a cell, where `cells` cells make up the whole.
std::size_t samples_along(std::size_t cells, std::size_t whole) {
    return std::max<std::size_t>(2, (whole + cells - 1) / cells);
}

/// The cells of a table, subdivided into one cell per sample.
struct FineCells {
    std::size_t columns, rows;  ///< of a cell
    HemisphereGrid grid;
};

FineCells divide(std::size_t azimuths, std::size_t elevations) {
    FineCells fine{samples_along(azimuths, 192), samples_along(elevations, 96), {}};
    const std::size_t columns = azimuths * fine.columns;
    for (std::size_t i = 0; i <= columns; ++i) {
        fine.grid.azimuths.push_back(
            2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(columns));
    }
    const auto sine_of = [&](std::size_t i) {
        return std::sin(
            std::numbers::pi / 2 * static_cast<double>(i) / static_cast<double>(elevations));
    };
    fine.grid.sines.push_back(0);
    for (std::size_t i = 0; i < elevations; ++i) {
        for (std::size_t k = 1; k <= fine.rows; ++k) {
            const double part = static_cast<double>(k) / static_cast<double>(fine.rows);
            fine.grid.sines.push_back(sine_of(i) + part * (sine_of(i + 1) - sine_of(i)));
        }
    }
    return fine;
}

}  // namespace

SkySum::SkySum(std::size_t azimuths, std::size_t elevations) {
    EXPECT(azimuths > 0 && elevations > 0);
    table_.azimuths = azimuths;
    table_.elevations = elevations;
    table_.radiance.assign(azimuths * elevations, 0.0);
}

void SkySum::add_sky(const SkyShape& shape, double horizontal_irradiance) {
    const FineCells fine = divide(table_.azimuths, table_.elevations);
    const HemisphereGrid& grid = fine.grid;
    const std::vector<double> radiances = radiance_of_cells(grid, shape.radiance);
    // The mean of a cell is weighted by the projection onto the horizontal.
    std::vector<double> seen(table_.radiance.size());
    std::vector<double> whole(table_.elevations);
    double sum = 0;
    for (std::size_t i = 0; i < grid.rows(); ++i) {
        const std::size_t row = i / fine.rows;
        const double weight = 0.5 * (grid.sines[i] + grid.sines[i + 1]) * grid.solid_angle(i, 0);
        whole[row] += weight * static_cast<double>(fine.columns);
        for (std::size_t j = 0; j < grid.columns(); ++j) {
            const double light = weight * radiances[i * grid.columns() + j];
            seen[row * table_.azimuths + j / fine.columns] += light;
            sum += light;
        }
    }
    EXPECT(sum > 0);
    for (std::size_t cell = 0; cell < seen.size(); ++cell) {
        table_.radiance[cell] +=
            horizontal_irradiance / sum * seen[cell] / whole[cell / table_.azimuths];
    }
    horizontal_irradiance_ += horizontal_irradiance;
}

void SkySum::add(const SkySum& other, double factor) {
    EXPECT(other.table_.radiance.size() == table_.radiance.size());
    for (std::size_t i = 0; i < table_.radiance.size(); ++i) {
        table_.radiance[i] += factor * other.table_.radiance[i];
    }
    horizontal_irradiance_ += factor * other.horizontal_irradiance_;
}

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "base/distribution.h"
#include "base/vec3.h"

namespace quasimc {

/// A function on the upper hemisphere, of the unit direction towards a point of it.
using HemisphereFunction = std::function<double(const Vec3&)>;

/// A cosine-distributed direction about +z: u0 is the square of the sine of the polar angle, the
/// azimuth 2 pi u1.
[[nodiscard]] Vec3 upward_cosine_direction(double u0, double u1);
/// A cosine-distributed direction about the unit vector `axis`.
[[nodiscard]] Vec3 cosine_direction_about(const Vec3& axis, double u0, double u1);

/// The upper hemisphere cut into cells by circles of equal elevation and of equal azimuth.
struct HemisphereGrid {
    std::vector<double> azimuths;  ///< borders, radians from x towards y; the last is 2 pi past the
                                   ///< first
    std::vector<double> sines;     ///< borders, of elevation: 0 to 1

    [[nodiscard]] std::size_t columns() const { return azimuths.size() - 1; }
    [[nodiscard]] std::size_t rows() const { return sines.size() - 1; }
    [[nodiscard]] std::size_t cells() const { return columns() * rows(); }
    /// Solid angle of a cell.
    [[nodiscard]] double solid_angle(std::size_t row, std::size_t column) const {
        return (sines[row + 1] - sines[row]) * (azimuths[column + 1] - azimuths[column]);
    }
    /// The direction to the middle of a cell.
    [[nodiscard]] Vec3 middle(std::size_t row, std::size_t column) const;
};

/// A grid fine enough for the skies of all models, that has a border at each of the given positions
/// and wherever a coordinate changes its sign.
[[nodiscard]] HemisphereGrid make_hemisphere_grid(
    std::span<const double> azimuths, std::span<const double> sines);

/// The direction at an azimuth and a sine of elevation.
[[nodiscard]] Vec3 hemisphere_direction(double azimuth, double sine);

/// A function in the middle of each cell, [row * columns + column].
[[nodiscard]] std::vector<double> radiance_of_cells(
    const HemisphereGrid& grid, const HemisphereFunction& f);

/// Projections of the cells of a grid onto the three planes of the axes; no coordinate changes its
/// sign within a cell.
class ProjectedCells {
  public:
    explicit ProjectedCells(const HemisphereGrid& grid);

    /// Integrals over a cell of |d.x|, |d.y| and d.z.
    [[nodiscard]] Vec3 integral(std::size_t row, std::size_t column) const {
        const Row& r = rows_[row];
        const Column& c = columns_[column];
        return {r.flat * c.x, r.flat * c.y, r.high * c.width};
    }

  private:
    /// Over the sine s of elevation: integrals of sqrt(1 - s^2) and of s.
    struct Row {
        double flat = 0, high = 0;
    };
    /// Over the azimuth: integrals of its |cosine|, of its |sine| and of 1.
    struct Column {
        double x = 0, y = 0, width = 0;
    };
    std::vector<Row> rows_;
    std::vector<Column> columns_;
};

/// Draws directions cell by cell: a cell in proportion to its share, uniformly inside (in solid
/// angle). The map of the unit square is continuous along each row of cells, and preserves the
/// uniformity of a point set: nothing is rejected.
class HemisphereSampler {
  public:
    /// @param shares  one per cell, not negative, not all 0
    HemisphereSampler(HemisphereGrid grid, std::span<const double> shares);

    struct Sample {
        Vec3 direction;
        double pdf = 0;  ///< per steradian
    };
    /// @param u0  picks the elevation, u1 the azimuth
    [[nodiscard]] Sample sample(double u0, double u1) const;
    /// The probability density, per steradian, of `direction` (unit); 0 below the horizon.
    [[nodiscard]] double pdf(const Vec3& direction) const;

  private:
    HemisphereGrid grid_;
    PiecewiseConstant2D cells_;
};

}  // namespace quasimc

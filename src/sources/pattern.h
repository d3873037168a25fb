#pragma once

#include <functional>
#include <vector>

#include "base/distribution.h"
#include "base/vec3.h"

namespace quasimc {

/// How a lamp spreads its light over the directions: radiant intensity for a flux of 1 [1/sr]. Its
/// integral over all directions is 1. Directions are unit vectors in the lamp's own frame: z is
/// where the lamp aims, x its zero azimuth.
///
/// Directions are drawn from a table of cells that are uniform in solid angle, in proportion to the
/// light in each, and weighted by what the intensity there differs from the cell's mean:
/// continuous, without a bias of the table.
class Pattern {
  public:
    /// Intensity, in any unit, at angle `theta` from the axis (0 to pi) and azimuth `phi` (0 to
    /// 2 pi).
    using Intensity = std::function<double(double theta, double phi)>;

    /// @param thetas  ascending, within 0 to pi, between which the intensity is smooth; outside
    /// them
    ///                it is 0
    /// @param phis    ascending, from 0 to 2 pi; {0, 2 pi} if the azimuth doesn't matter
    Pattern(
        Intensity intensity, const std::vector<double>& thetas, const std::vector<double>& phis);

    /// The intensity given, integrated over all directions: flux in the unit of `intensity` x sr.
    [[nodiscard]] double total() const { return cells_.total(); }
    [[nodiscard]] double intensity(const Vec3& direction) const;

    struct Drawn {
        Vec3 direction;
        double weight = 1;  ///< intensity / density; its mean is 1
    };
    [[nodiscard]] Drawn draw(double u0, double u1) const;

  private:
    [[nodiscard]] std::size_t columns() const { return phis_.size() - 1; }

    Intensity intensity_;
    std::vector<double> rows_;  // (1 - cos theta) / 2 at the borders of the rows of cells
    std::vector<double> phis_;
    std::vector<double> mass_;  // [row][column] share of the light in the cell
    PiecewiseConstant2D cells_;
    double low_ = 0, high_ = 0;  // theta at the ends
};

/// The same intensity in all directions.
[[nodiscard]] Pattern isotropic_pattern();
/// A flat Lambertian surface: cos theta / pi, nothing behind it.
[[nodiscard]] Pattern cosine_pattern();
/// (n + 1) / (2 pi) cos^n theta, n >= 0, nothing behind it. n = 1: cosine_pattern.
[[nodiscard]] Pattern power_cosine_pattern(double exponent);
/// The same intensity up to `inner` radians from the axis, falling to 0 at `outer` by the smooth
/// step 3 x^2 - 2 x^3 of the angle; 0 <= inner <= outer <= pi, outer > 0.
[[nodiscard]] Pattern spot_pattern(double inner, double outer);
/// A thin tube along z with a Lambertian surface: sin theta / pi^2.
[[nodiscard]] Pattern tube_pattern();

/// `borders` with each interval cut into pieces no longer than `longest`, at least `least` of them.
[[nodiscard]] std::vector<double> refined(
    const std::vector<double>& borders, double longest, int least);

}  // namespace quasimc

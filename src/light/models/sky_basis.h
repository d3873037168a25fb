#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "quasimc/source.h"

namespace quasimc {

/// Piecewise-linear basis functions on the upper hemisphere (daylight coefficients, Tregenza and
/// Waters 1983). Their nodes lie about equally far apart on rings of equal elevation; the topmost
/// ring is the zenith. Each function is 1 at its node and 0 at its neighbours, linear in elevation
/// and azimuth, and constant below the lowest ring. All sum to 1 everywhere.
class SkyBasis {
  public:
    /// @param rings  at least 2
    explicit SkyBasis(std::uint32_t rings);

    [[nodiscard]] std::uint32_t nodes() const { return first_.back(); }

    /// Value of a node's basis function at a direction.
    struct Share {
        std::uint32_t node = 0;
        double weight = 0;
    };
    /// The basis functions that may be above 0 at a direction above the horizon.
    /// @param to_light  unit, z up
    [[nodiscard]] std::array<Share, 4> shares(const Vec3& to_light) const;
    /// The basis function of a node as a sky.
    [[nodiscard]] SkyShape basis_function(std::uint32_t node) const;

    /// Coefficients of a sky, fitted to its radiance (expectation maximization, Richardson 1972 and
    /// Lucy 1974: nothing is negative) and scaled to the sky's irradiance on the horizontal; zeros
    /// if all of its light lies between the sampled directions.
    /// @returns by node: irradiance of its basis function on the horizontal, for a spectrum of 1
    [[nodiscard]] std::vector<double> light_of_sky(const Source& sky) const;
    /// Coefficients of a beam of irradiance 1 on the plane facing it, in the basis functions around
    /// it, which together send equal flux through a sphere.
    /// @returns the irradiance of each basis function on the horizontal
    [[nodiscard]] std::array<Share, 4> light_of_beam(const Vec3& to_light) const;

  private:
    /// A direction and its part of the hemisphere.
    struct QuadratureNode {
        Vec3 direction;
        double weight = 0;  ///< its solid angle, in any unit
        std::array<Share, 4> shares;
    };

    [[nodiscard]] std::uint32_t in_ring(std::uint32_t ring) const {
        return first_[ring + 1] - first_[ring];
    }
    [[nodiscard]] double elevation(std::uint32_t ring) const;
    void put_ring(std::uint32_t ring, double weight, double azimuth, Share* to) const;
    void set_samples();
    [[nodiscard]] std::vector<double> fit(const Source& sky) const;

    double step_;                       // between rings, radians
    std::vector<std::uint32_t> first_;  // node of each ring from below, and their number
    std::vector<QuadratureNode> samples_;
    std::vector<double>
        sampled_weight_;        // by node: weighted sum of its basis function over the samples
    std::vector<double> sine_;  // by node: mean sine of elevation under its basis function
};

}  // namespace quasimc

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "quasimc/source.h"

namespace quasimc {

/// Directions of the upper hemisphere between which light is interpolated: rings about equally far
/// apart, the topmost of which is the zenith, each of nodes about as far apart. Every node has a
/// hat, 1 there and falling to 0 at its neighbours, linear in elevation and azimuth; below the
/// lowest ring it stays as it is. All hats add up to 1 everywhere.
class SkyBasis {
  public:
    /// @param rings  at least 2
    explicit SkyBasis(std::uint32_t rings);

    [[nodiscard]] std::uint32_t nodes() const { return first_.back(); }

    /// A node's hat at a direction.
    struct Share {
        std::uint32_t node = 0;
        double weight = 0;
    };
    /// Those of all hats that may be above 0 at a direction above the horizon.
    /// @param to_light  unit, z up
    [[nodiscard]] std::array<Share, 4> shares(const Vec3& to_light) const;
    /// The hat of a node as a sky.
    [[nodiscard]] SkyShape basis_function(std::uint32_t node) const;

    /// A sky in hats, fitted to its radiance (expectation maximization, Richardson 1972 and Lucy
    /// 1974: nothing is negative), scaled together to the sky's irradiance on the horizontal; no
    /// light if all of it lies between the sampled directions. @returns by node: its hat's
    /// irradiance on the horizontal, for a spectrum of
    /// 1
    [[nodiscard]] std::vector<double> light_of_sky(const Source& sky) const;
    /// A beam of irradiance 1 on the plane that faces it in the hats about it, which together send
    /// as much through a sphere. @returns the irradiance of each hat on the horizontal
    [[nodiscard]] std::array<Share, 4> light_of_beam(const Vec3& to_light) const;

  private:
    /// A direction that stands for a part of the hemisphere.
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
    std::vector<double> sampled_weight_;  // by node: its hat's sum over them, by weight
    std::vector<double> sine_;            // by node: mean sine of elevation under its hat
};

}  // namespace quasimc

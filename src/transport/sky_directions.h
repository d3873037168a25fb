#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "transport/prepared_scene.h"

namespace quasimc {

/// Point `i` of `count` on the unit square, well spread: a shifted lattice of one of four numbers.
/// It is mapped to the hemisphere about a horizontal axis of some azimuth, and back to the square
/// by height and azimuth. All maps keep areas, so over all values of `placing` the points are
/// uniform, and their number in a cone, a band of heights or a sector varies.
/// @param placing  uniform in the unit cube: shift along and about the axis, and its azimuth with
///        the number
[[nodiscard]] std::array<double, 2> hemisphere_lattice(
    std::uint32_t i, std::uint32_t count, const std::array<double, 3>& placing);

/// Direction `i` of `count` well-spread samples of a light, with the density of
/// SourceSampler::draw_direction. @param placing  as in hemisphere_lattice()
[[nodiscard]] DirectionSample lattice_direction(
    const BoundSource& light,
    std::uint32_t i,
    std::uint32_t count,
    const std::array<double, 3>& placing);

/// Directions shared by all skies of a scene. Each sky samples some of them, in proportion to its
/// light. All skies are evaluated along every direction, weighted by the density of all together
/// (the balance heuristic of Veach and Guibas 1995).
class SkyDirections {
  public:
    explicit SkyDirections(const PreparedScene& prepared);

    [[nodiscard]] std::span<const BoundSource* const> skies() const { return skies_; }
    /// Probability that a path of all lights starts at a sky.
    [[nodiscard]] double probability() const { return probability_; }
    /// Direction `i` of `count`, with its density over all skies.
    [[nodiscard]] DirectionSample direction(
        std::uint32_t i, std::uint32_t count, const std::array<double, 3>& placing) const;

    /// The density of a direction over all skies, for very many directions.
    [[nodiscard]] double density(const Vec3& direction) const;

  private:
    /// Calls `visit(sky, first, last)` with the directions that each sky samples.
    template <typename Visit>
    void for_each_sky(std::uint32_t count, const Visit& visit) const;

    std::vector<const BoundSource*> skies_;
    double probability_ = 0;
};

}  // namespace quasimc

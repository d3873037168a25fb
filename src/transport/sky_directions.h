#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "transport/prepared_scene.h"

namespace quasimc {

/// More directions are not sheared, which leaves a fifth of the variance.
inline constexpr std::uint32_t kMaxShearedDirections = 256;

/// Point `i` of `count` on the unit square, well spread: a lattice of the golden ratio, sheared in
/// one of four ways, or of one of four numbers, and shifted, laid on the hemisphere as about a
/// horizontal axis of some azimuth, and flat on the square again by height and azimuth. All of it
/// keeps areas, so that over all placements the points together are uniform; and how many lie in a
/// cone, a band of heights or a sector varies.
/// @param placing  uniform in the unit cube: shift along and about the axis, and its azimuth with
///        the way of shearing
[[nodiscard]] std::array<double, 2> hemisphere_lattice(
    std::uint32_t i, std::uint32_t count, const std::array<double, 3>& placing);

/// Direction `i` of `count` that a light draws, well spread; all together have the density of
/// SourceSampler::draw_direction. @param placing  as in hemisphere_lattice()
[[nodiscard]] DirectionSample lattice_direction(
    const BoundSource& light,
    std::uint32_t i,
    std::uint32_t count,
    const std::array<double, 3>& placing);

/// Directions that serve all skies of a scene at once: each sky draws some, in proportion to its
/// light, and whichever drew a direction, all skies send their light along it, weighted by the
/// density of all together (the balance heuristic of Veach and Guibas 1995).
class SkyDirections {
  public:
    explicit SkyDirections(const PreparedScene& prepared);

    [[nodiscard]] std::span<const BoundSource* const> skies() const { return skies_; }
    /// Share of the skies in the paths of all lights.
    [[nodiscard]] double probability() const { return probability_; }
    /// Direction `i` of `count`, with the density with which all skies together draw it.
    [[nodiscard]] DirectionSample direction(
        std::uint32_t i, std::uint32_t count, const std::array<double, 3>& placing) const;

    /// The density with which all skies together draw a direction, of very many.
    [[nodiscard]] double density(const Vec3& direction) const;

  private:
    /// Calls `visit(sky, first, last)` with the directions that each draws.
    template <typename Visit>
    void for_each_sky(std::uint32_t count, const Visit& visit) const;

    std::vector<const BoundSource*> skies_;
    double probability_ = 0;
};

}  // namespace quasimc

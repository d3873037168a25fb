#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "transport/prepared_scene.h"

namespace quasimc {

/// A turn of space about the origin.
struct Rotation {
    Vec3 x, y, z;  ///< where it takes the axes

    [[nodiscard]] Vec3 operator()(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
};

/// A rotation, uniform over all of them if `u` is uniform in the unit cube.
[[nodiscard]] Rotation random_rotation(const std::array<double, 3>& u);

/// Point `i` of `count` on the unit square, well spread: a lattice of the golden ratio on the
/// hemisphere, turned, and laid flat by height and azimuth (which keeps areas). Over all rotations
/// each point is uniform, and how many lie in a cone, a band of heights or a sector varies.
[[nodiscard]] std::array<double, 2> rotated_lattice(
    std::uint32_t i, std::uint32_t count, const Rotation& rotation);

/// Direction `i` of `count` that a light draws, well spread; each direction alone has the density
/// of SourceSampler::draw_direction.
[[nodiscard]] DrawnDirection lattice_direction(
    const BoundSource& light, std::uint32_t i, std::uint32_t count, const Rotation& rotation);

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
    [[nodiscard]] DrawnDirection direction(
        std::uint32_t i, std::uint32_t count, const Rotation& rotation) const;

  private:
    /// Calls `visit(sky, first, last)` with the directions that each draws.
    template <typename Visit>
    void for_each_sky(std::uint32_t count, const Visit& visit) const;

    std::vector<const BoundSource*> skies_;
    double probability_ = 0;
};

}  // namespace quasimc

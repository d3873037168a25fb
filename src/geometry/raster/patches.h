#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/raster/projected_scene.h"

namespace quasimc {

/// Parts of triangles over which light that leaves them is taken as constant: a triangle of level k
/// is cut into 4^k similar ones. Parts of level k - 1 hold four of them each.
class Patches {
  public:
    /// More would number a triangle's parts beyond what is of use.
    static constexpr int kFinest = 7;
    static constexpr std::uint8_t kNone = 255;  ///< a triangle that has no patches

    Patches() = default;
    /// @param levels  by triangle, to kFinest, or kNone
    explicit Patches(std::vector<std::uint8_t> levels);

    /// Of all triangles.
    [[nodiscard]] std::uint32_t count() const { return first_.back(); }
    [[nodiscard]] std::uint32_t triangles() const {
        return static_cast<std::uint32_t>(levels_.size());
    }
    [[nodiscard]] bool has(std::uint32_t triangle) const { return levels_[triangle] != kNone; }
    [[nodiscard]] int level(std::uint32_t triangle) const { return levels_[triangle]; }
    /// The patches of a triangle are [first(triangle), first(triangle + 1)).
    [[nodiscard]] std::uint32_t first(std::uint32_t triangle) const { return first_[triangle]; }

    /// The part of a triangle of a level in which a place lies; row by row from v = 0 up.
    [[nodiscard]] static std::uint32_t part(int level, double u, double v) {
        const std::int32_t n = std::int32_t{1} << level;
        const double along = u * n;
        const double across = v * n;
        const std::int32_t j = clamped(across, n - 1);
        const std::int32_t i = clamped(along, n - 1 - j);
        const bool is_turned = along - i + across - j > 1 && i + j < n - 1;
        return static_cast<std::uint32_t>(j * (2 * n - j) + 2 * i + (is_turned ? 1 : 0));
    }
    /// The part of the level above that holds a part.
    [[nodiscard]] static std::uint32_t parent(int level, std::uint32_t part);

    /// A stretch of a line on a triangle that lies in one part.
    struct Stretch {
        std::uint32_t part = 0;
        double share = 0;  ///< of the line
    };
    /// What of a line from `a` to `b` lies in which part; all shares add up to 1.
    static void cut(
        int level, const Barycentric& a, const Barycentric& b, std::vector<Stretch>& stretches);

  private:
    [[nodiscard]] static std::int32_t clamped(double x, std::int32_t most) {
        const auto whole = static_cast<std::int32_t>(x);
        return whole < 0 || x < 0 ? 0 : whole > most ? most : whole;
    }

    std::vector<std::uint8_t> levels_;
    std::vector<std::uint32_t> first_{0};
};

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/convex_piece.h"
#include "raster/projected_scene.h"

namespace quasimc {

/// The 4^k similar parts of a triangle, numbered row by row from v = 0 up.
class TriangleParts {
  public:
    /// @param level  k
    explicit TriangleParts(int level) : level_(level) {}

    /// The part in which a point lies.
    [[nodiscard]] std::uint32_t at(double u, double v) const {
        const std::int32_t n = std::int32_t{1} << level_;
        const double along = u * n;
        const double across = v * n;
        const std::int32_t j = clamped(across, n - 1);
        const std::int32_t i = clamped(along, n - 1 - j);
        const bool is_turned = along - i + across - j > 1 && i + j < n - 1;
        return static_cast<std::uint32_t>(j * (2 * n - j) + 2 * i + (is_turned ? 1 : 0));
    }
    /// The part of the level above that holds a part.
    [[nodiscard]] std::uint32_t parent(std::uint32_t part) const;
    /// The corners of a part, u and v.
    [[nodiscard]] ConvexPiece corners(std::uint32_t part) const;

    /// A segment of a line on a triangle that lies in one part.
    struct Segment {
        std::uint32_t part = 0;
        double begin = 0, end = 1;  ///< as fractions of the line
        [[nodiscard]] double share() const { return end - begin; }
    };
    /// The segments of a line from `a` to `b`; all fractions sum to 1.
    /// @param scratch  memory of the result
    [[nodiscard]] std::span<const Segment> segments(
        const Barycentric& a, const Barycentric& b, std::vector<Segment>& scratch) const;

  private:
    [[nodiscard]] static std::int32_t clamped(double x, std::int32_t most) {
        const auto whole = static_cast<std::int32_t>(x);
        return whole < 0 || x < 0 ? 0 : whole > most ? most : whole;
    }

    int level_;
};

}  // namespace quasimc

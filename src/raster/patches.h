#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/mesh/crossings.h"
#include "raster/convex_piece.h"
#include "raster/cut_triangle.h"
#include "raster/projected_scene.h"

namespace quasimc {

/// Parts of triangles over which light that leaves them is taken as constant: a triangle of level k
/// is cut into 4^k similar ones. Parts of level k - 1 hold four of them each. Where surfaces cross,
/// parts are cut once more, so that none lies on both sides of another surface (CutTriangle).
class Patches {
  public:
    /// More would number a triangle's parts beyond what is of use.
    static constexpr int kFinest = 7;
    static constexpr std::uint8_t kNone = 255;  ///< a triangle that has no patches

    Patches() = default;
    /// @param levels  by triangle, to kFinest, or kNone
    /// @param crossings  in the order of their triangles, whose levels are at least 1
    explicit Patches(
        std::vector<std::uint8_t> levels, std::span<const SurfaceCrossing> crossings = {});

    /// Of all triangles.
    [[nodiscard]] std::uint32_t count() const { return first_.back(); }
    [[nodiscard]] std::uint32_t triangles() const {
        return static_cast<std::uint32_t>(levels_.size());
    }
    [[nodiscard]] bool has(std::uint32_t triangle) const { return levels_[triangle] != kNone; }
    [[nodiscard]] int level(std::uint32_t triangle) const { return levels_[triangle]; }
    /// The patches of a triangle are [first(triangle), first(triangle + 1)).
    [[nodiscard]] std::uint32_t first(std::uint32_t triangle) const { return first_[triangle]; }
    /// How a triangle is cut where others cross it; null if none does.
    [[nodiscard]] const CutTriangle* cut_of(std::uint32_t triangle) const {
        return cut_of_.empty() || cut_of_[triangle] == 0 ? nullptr : &cuts_[cut_of_[triangle] - 1];
    }
    /// How many are cut.
    [[nodiscard]] std::size_t cut_triangles() const { return cuts_.size(); }
    /// The patch in which a place of a triangle lies.
    [[nodiscard]] std::uint32_t at(std::uint32_t triangle, double u, double v) const {
        const std::uint32_t part = Patches::part(level(triangle), u, v);
        const CutTriangle* cut = cut_of(triangle);
        return first(triangle) + (cut == nullptr ? part : cut->patch(part, u, v));
    }
    /// Of the area of a triangle, what its patch number `i` covers.
    [[nodiscard]] double share(std::uint32_t triangle, std::uint32_t i) const;

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

    /// The corners of a part, u and v.
    [[nodiscard]] static ConvexPiece corners(int level, std::uint32_t part);

    /// A stretch of a line on a triangle that lies in one part.
    struct Stretch {
        std::uint32_t part = 0;
        double begin = 0, end = 1;  ///< as parts of the line
        [[nodiscard]] double share() const { return end - begin; }
    };
    /// What of a line from `a` to `b` lies in which part; all shares add up to 1.
    static void cut(
        int level, const Barycentric& a, const Barycentric& b, std::vector<Stretch>& stretches);
    /// Calls visit(patch, share) for what of a line on a triangle lies in which patch.
    /// @param scratch  what the call may use
    template <typename Visit>
    void cut(
        std::uint32_t triangle,
        const Barycentric& a,
        const Barycentric& b,
        std::vector<Stretch>& scratch,
        const Visit& visit) const {
        cut(level(triangle), a, b, scratch);
        const std::uint32_t first = first_[triangle];
        const CutTriangle* cut = cut_of(triangle);
        for (const Stretch& stretch : scratch) {
            if (cut == nullptr) {
                visit(first + stretch.part, stretch.share());
                continue;
            }
            const auto at = [&](double f) {
                return Point2{a.u + f * (double{b.u} - a.u), a.v + f * (double{b.v} - a.v)};
            };
            cut->cut(
                stretch.part, at(stretch.begin), at(stretch.end),
                [&](std::uint32_t patch, double share) {
                    visit(first + patch, share * stretch.share());
                });
        }
    }

  private:
    [[nodiscard]] static std::int32_t clamped(double x, std::int32_t most) {
        const auto whole = static_cast<std::int32_t>(x);
        return whole < 0 || x < 0 ? 0 : whole > most ? most : whole;
    }

    std::vector<std::uint8_t> levels_;
    std::vector<std::uint32_t> first_{0};
    std::vector<CutTriangle> cuts_;
    std::vector<std::uint32_t> cut_of_;  // 1 + that of cuts_, by triangle; 0: none
};

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh/crossings.h"
#include "geometry/mesh/point2.h"

namespace quasimc {

/// A triangle that other surfaces cross, cut into patches that lie on one side of them: the parts
/// of its level (Patches), those that are crossed cut along the lines. What no surface separates
/// stays together, and what is small goes to a neighbour. The first 4^level patches are numbered
/// as the parts, some of which may be empty.
class CutTriangle {
  public:
    /// @param crossings  of the triangle, at least one
    CutTriangle(int level, std::span<const SurfaceCrossing> crossings);

    [[nodiscard]] std::uint32_t patches() const {
        return static_cast<std::uint32_t>(areas_.size());
    }
    /// Of the triangle, the part that a patch covers; 0 of some.
    [[nodiscard]] double area(std::uint32_t patch) const { return areas_[patch]; }
    /// Patches of the same number here make one patch of the level above, on one side of all that
    /// crosses it.
    [[nodiscard]] std::uint32_t group(std::uint32_t patch) const { return groups_[patch]; }

    /// The patch that contains a point of a part.
    [[nodiscard]] std::uint32_t patch(std::uint32_t part, double u, double v) const {
        std::uint32_t at = links_[part];
        while ((at & kPatch) == 0) {
            const Line& line = lines_[at];
            at = links_[link_of(at, line.at(u, v) > 0)];
        }
        return at & ~kPatch;
    }
    /// Calls visit(patch, share of the way from a to b) for a line that lies in a part.
    template <typename Visit>
    void cut(std::uint32_t part, const Point2& a, const Point2& b, const Visit& visit) const {
        cut_below(links_[part], a, b, 1, visit);
    }

  private:
    friend class TriangleCutter;
    static constexpr std::uint32_t kPatch = 0x80000000U;

    /// Where a piece is cut in two: along 0 = c + by_u u + by_v v.
    struct Line {
        double c, by_u, by_v;
        [[nodiscard]] double at(double u, double v) const { return c + by_u * u + by_v * v; }
    };

    [[nodiscard]] std::size_t link_of(std::uint32_t line, bool is_above) const {
        return parts_ + std::size_t{2} * line + (is_above ? 1 : 0);
    }
    template <typename Visit>
    void cut_below(
        std::uint32_t at, const Point2& a, const Point2& b, double share, const Visit& visit)
        const {
        if ((at & kPatch) != 0) {
            visit(at & ~kPatch, share);
            return;
        }
        const double from = lines_[at].at(a.s, a.t);
        const double to = lines_[at].at(b.s, b.t);
        if ((from > 0) == (to > 0)) {
            cut_below(links_[link_of(at, from > 0)], a, b, share, visit);
            return;
        }
        const double f = from / (from - to);
        const Point2 middle{a.s + f * (b.s - a.s), a.t + f * (b.t - a.t)};
        cut_below(links_[link_of(at, from > 0)], a, middle, f * share, visit);
        cut_below(links_[link_of(at, to > 0)], middle, b, (1 - f) * share, visit);
    }

    std::size_t parts_;
    std::vector<Line> lines_;
    std::vector<std::uint32_t> links_;  // of each part, and below and above each line
    std::vector<double> areas_;
    std::vector<std::uint32_t> groups_;
};

}  // namespace quasimc

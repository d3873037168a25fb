#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh/crossings.h"
#include "geometry/mesh/point2.h"

namespace quasimc {

/// A triangle cut into patches that lie on one side of all surfaces crossing it: the parts of its
/// level (Patches), each further cut along crossing segments. Pieces that no surface separates stay
/// together, and small ones join a neighbour. The first 4^level patches are numbered like the
/// parts; some may be empty.
class CutTriangle {
  public:
    /// @param crossings  with other surfaces, at least one
    CutTriangle(int level, std::span<const SurfaceCrossing> crossings);

    [[nodiscard]] std::uint32_t patches() const {
        return static_cast<std::uint32_t>(areas_.size());
    }
    /// The area fraction of a patch; 0 for empty ones.
    [[nodiscard]] double area(std::uint32_t patch) const { return areas_[patch]; }

    /// The part of the level above in which a patch lies.
    [[nodiscard]] std::uint32_t parent(std::uint32_t patch) const { return parents_[patch]; }
    /// The patch that contains a point of a part.
    [[nodiscard]] std::uint32_t patch(std::uint32_t part, double u, double v) const {
        std::uint32_t at = links_[part];
        while ((at & kPatch) == 0) {
            const Line& line = lines_[at];
            at = links_[link_of(at, line.at(u, v) > 0)];
        }
        return at & ~kPatch;
    }
    /// Calls visit(patch, fraction of the line) along the line from a to b, which lies in a part.
    template <typename Visit>
    void cut(std::uint32_t part, const Point2& a, const Point2& b, const Visit& visit) const {
        cut_below(links_[part], a, b, 1, visit);
    }

  private:
    friend class TriangleCutter;
    static constexpr std::uint32_t kPatch = 0x80000000U;

    /// A cut through a piece, along 0 = c + by_u u + by_v v.
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
    std::vector<std::uint32_t> links_;  // for each part, and below and above each line
    std::vector<double> areas_;
    std::vector<std::uint32_t> parents_;  // by patch
};

}  // namespace quasimc

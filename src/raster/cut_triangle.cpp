#include "raster/cut_triangle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "raster/convex_piece.h"
#include "raster/patches.h"

namespace quasimc {
namespace {

/// Relative to a part's area: smaller pieces are not cut off.
constexpr double kMinPiece = 1e-3;
/// Relative to a part's side: lines within this distance coincide.
constexpr double kOneLine = 2e-3;
/// Relative to a part's area: smaller patches join a neighbour, for few lines hit them.
constexpr double kSmallPatch = 0.25;
/// Pieces stay apart if surfaces cover this fraction of their common border.
constexpr double kSeparated = 0.25;
/// Limits for one part: its pieces, and its crossing segments, the longest first.
constexpr std::size_t kMaxPieces = 40, kMaxKnown = 64;

/// Disjoint sets of pieces; some pairs must stay apart.
class Unions {
  public:
    explicit Unions(std::vector<double> areas)
        : areas_(std::move(areas)),
          of_(areas_.size()),
          apart_(areas_.size(), std::vector<bool>(areas_.size())) {
        std::iota(of_.begin(), of_.end(), std::size_t{0});
    }

    [[nodiscard]] std::size_t of(std::size_t piece) const { return of_[piece]; }
    [[nodiscard]] double area(std::size_t piece) const { return areas_[of_[piece]]; }
    void keep_apart(std::size_t a, std::size_t b) {
        apart_[of_[a]][of_[b]] = apart_[of_[b]][of_[a]] = true;
    }
    [[nodiscard]] bool may_join(std::size_t a, std::size_t b) const {
        return of_[a] != of_[b] && !apart_[of_[a]][of_[b]];
    }
    void join(std::size_t a, std::size_t b) {
        const std::size_t to = of_[a];
        const std::size_t gone = of_[b];
        areas_[to] += areas_[gone];
        for (std::size_t i = 0; i < of_.size(); ++i) {
            of_[i] = of_[i] == gone ? to : of_[i];
            if (apart_[gone][i]) {
                apart_[to][i] = apart_[i][to] = true;
            }
        }
    }

  private:
    std::vector<double> areas_;
    std::vector<std::size_t> of_;
    std::vector<std::vector<bool>> apart_;
};

}  // namespace

/// Cuts the parts of a triangle into pieces.
class TriangleCutter {
  public:
    TriangleCutter(int level, std::span<const SurfaceCrossing> crossings, CutTriangle& to)
        : level_(level), side_(std::ldexp(1.0, -level)), to_(to), crossings_(to.parts_) {
        for (const SurfaceCrossing& crossing : crossings) {
            sort_into_parts(crossing);
        }
    }

    void cut() {
        std::vector<std::vector<std::uint32_t>> families(to_.parts_ / 4);
        for (std::uint32_t part = 0; part < to_.parts_; ++part) {
            families[TriangleParts(level_).parent(part)].push_back(part);
        }
        for (const std::vector<std::uint32_t>& parts : families) {
            cut_family(parts);
        }
    }

  private:
    struct Piece {
        ConvexPiece corners;
        std::uint32_t part;
        std::size_t link;  // index of the link that leads here
    };
    struct Border {
        std::size_t a, b;  // pieces
        double length;
        double separated;  // length covered by surfaces
    };

    void sort_into_parts(const SurfaceCrossing& crossing) {
        std::vector<TriangleParts::Segment> scratch;
        const Barycentric from{
            static_cast<float>(crossing.from.s), static_cast<float>(crossing.from.t)};
        const Barycentric to{static_cast<float>(crossing.to.s), static_cast<float>(crossing.to.t)};
        for (const TriangleParts::Segment& segment :
             TriangleParts(level_).segments(from, to, scratch)) {
            crossings_[segment.part].push_back({crossing.from, crossing.to});
        }
    }

    [[nodiscard]] double part_area() const { return side_ * side_ / 2; }

    void cut_family(const std::vector<std::uint32_t>& parts) {
        std::vector<Piece> pieces;
        std::vector<PlaneSegment> surfaces;
        for (const std::uint32_t part : parts) {
            cut_part(part, pieces);
            surfaces.insert(surfaces.end(), crossings_[part].begin(), crossings_[part].end());
        }
        std::vector<double> areas;
        areas.reserve(pieces.size());
        for (const Piece& piece : pieces) {
            areas.push_back(area_of(piece.corners));
        }
        Unions unions(std::move(areas));
        std::vector<Border> borders = find_borders(pieces, surfaces);
        for (const Border& border : borders) {
            if (border.separated > kSeparated) {
                unions.keep_apart(border.a, border.b);
            }
        }
        join_in_parts(pieces, borders, unions);
        join_small(borders, pieces.size(), unions);
        const std::vector<std::uint32_t> patches = number(pieces, parts, unions);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            to_.links_[pieces[i].link] = CutTriangle::kPatch | patches[i];
        }
    }

    /// Adds the pieces of a part, cut along all crossing segments, the longest first.
    void cut_part(std::uint32_t part, std::vector<Piece>& pieces) {
        const std::size_t first = pieces.size();
        pieces.push_back({TriangleParts(level_).corners(part), part, part});
        const ConvexPiece whole = pieces.back().corners;
        std::stable_sort(
            crossings_[part].begin(), crossings_[part].end(),
            [&](const PlaneSegment& a, const PlaneSegment& b) {
                return length_within(whole, a.from, a.to) > length_within(whole, b.from, b.to);
            });
        crossings_[part].resize(std::min(crossings_[part].size(), kMaxKnown));
        for (const PlaneSegment& crossing : crossings_[part]) {
            for (std::size_t i = pieces.size(); i-- > first;) {
                if (pieces.size() - first < kMaxPieces) {
                    cut_piece(crossing, i, pieces);
                }
            }
        }
    }

    void cut_piece(const PlaneSegment& crossing, std::size_t i, std::vector<Piece>& pieces) {
        if (length_within(pieces[i].corners, crossing.from, crossing.to) < kOneLine * side_) {
            return;
        }
        auto [right, left] = parts_beside(pieces[i].corners, crossing.from, crossing.to);
        if (std::min(area_of(right), area_of(left)) < kMinPiece * part_area()) {
            return;
        }
        const auto line = static_cast<std::uint32_t>(to_.lines_.size());
        const Point2 d{crossing.to.s - crossing.from.s, crossing.to.t - crossing.from.t};
        to_.lines_.push_back(
            {d.t * crossing.from.s - d.s * crossing.from.t, -d.t, d.s});  // positive on the left
        to_.links_.resize(to_.links_.size() + 2);
        to_.links_[pieces[i].link] = line;
        pieces[i].corners = std::move(right);
        pieces[i].link = to_.link_of(line, false);
        pieces.push_back({std::move(left), pieces[i].part, to_.link_of(line, true)});
    }

    /// The common borders of all pairs of adjacent pieces, the longest first.
    [[nodiscard]] std::vector<Border> find_borders(
        const std::vector<Piece>& pieces, std::span<const PlaneSegment> surfaces) const {
        const double tolerance = kOneLine * side_;
        std::vector<Border> borders;
        for (std::size_t a = 0; a < pieces.size(); ++a) {
            for (std::size_t b = a + 1; b < pieces.size(); ++b) {
                const auto common = common_border(pieces[a].corners, pieces[b].corners, tolerance);
                if (common) {
                    borders.push_back(
                        {a, b, length_of(*common), share_along(*common, surfaces, tolerance)});
                }
            }
        }
        std::stable_sort(borders.begin(), borders.end(), [](const Border& a, const Border& b) {
            return a.length > b.length;
        });
        return borders;
    }

    static void join_in_parts(
        const std::vector<Piece>& pieces, const std::vector<Border>& borders, Unions& unions) {
        for (const Border& border : borders) {
            if (pieces[border.a].part == pieces[border.b].part &&
                unions.may_join(border.a, border.b)) {
                unions.join(border.a, border.b);
            }
        }
    }

    /// Joins small pieces to neighbours, the smallest first.
    void join_small(const std::vector<Border>& borders, std::size_t pieces, Unions& unions) const {
        for (std::size_t joined = 1; joined < pieces; ++joined) {
            const Border* next = nullptr;
            double least = kSmallPatch * part_area();
            for (const Border& border : borders) {
                const double area = std::min(unions.area(border.a), unions.area(border.b));
                if (area < least && unions.may_join(border.a, border.b)) {
                    next = &border;
                    least = area;
                }
            }
            if (next == nullptr) {
                return;
            }
            unions.join(next->a, next->b);
        }
    }

    /// Numbers the patch of each piece and adds the patches: one that holds a whole part has its
    /// number; others have that of a part that is cut, or a new one.
    [[nodiscard]] std::vector<std::uint32_t> number(
        const std::vector<Piece>& pieces,
        const std::vector<std::uint32_t>& parts,
        const Unions& unions) {
        constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> number_of(pieces.size(), kNone);
        std::vector<std::uint32_t> free;
        for (const std::uint32_t part : parts) {
            const auto holds = [&](const Piece& piece) { return piece.part == part; };
            const auto first = std::find_if(pieces.begin(), pieces.end(), holds);
            if (std::count_if(pieces.begin(), pieces.end(), holds) == 1) {
                number_of[unions.of(static_cast<std::size_t>(first - pieces.begin()))] = part;
            } else {
                free.push_back(part);
            }
        }
        std::vector<std::uint32_t> patches;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            std::uint32_t& patch = number_of[unions.of(i)];
            if (patch == kNone && free.empty()) {
                patch = to_.patches();
                to_.areas_.push_back(0);
                to_.parents_.push_back(to_.parents_[parts.front()]);
            } else if (patch == kNone) {
                patch = free.back();
                free.pop_back();
            }
            to_.areas_[patch] += 2 * area_of(pieces[i].corners);
            patches.push_back(patch);
        }
        return patches;
    }

    int level_;
    double side_;  // of a part
    CutTriangle& to_;
    std::vector<std::vector<PlaneSegment>> crossings_;  // by part
};

CutTriangle::CutTriangle(int level, std::span<const SurfaceCrossing> crossings)
    : parts_(std::size_t{1} << (2U * static_cast<unsigned>(level))),
      links_(parts_),
      areas_(parts_) {
    for (std::uint32_t part = 0; part < parts_; ++part) {
        parents_.push_back(TriangleParts(level).parent(part));
    }
    TriangleCutter(level, crossings, *this).cut();
}

}  // namespace quasimc

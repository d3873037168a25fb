#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/mesh/point2.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// A corner seen along the polygon's normal.
struct FlatCorner : Point2 {
    std::size_t index = 0;  ///< among the corners given
};

[[nodiscard]] inline bool same_point(const FlatCorner& a, const FlatCorner& b) {
    return a.s == b.s && a.t == b.t;
}

/// What counts as in the way of an ear.
enum class Blocking { inside_or_on_border, inside };

/// Whether corner `p` is in the way of the ear a, b, c, which turns left. Corners at the same point
/// as one of its own are not.
[[nodiscard]] inline bool blocks_ear(
    const FlatCorner& a,
    const FlatCorner& b,
    const FlatCorner& c,
    const FlatCorner& p,
    Blocking blocking) {
    if (same_point(p, a) || same_point(p, b) || same_point(p, c)) {
        return false;
    }
    const double u = turn(a, b, p), v = turn(b, c, p), w = turn(c, a, p);
    return blocking == Blocking::inside ? u > 0 && v > 0 && w > 0 : u >= 0 && v >= 0 && w >= 0;
}

/// Cuts a polygon of corners in counter-clockwise order into triangles, one corner after the other:
/// the first without area or, if there is none, the first ear. Nothing if none is left to cut.
/// Looks at all corners for every ear: for few corners. Ear clipping: Meisters, G. H. (1975).
/// Polygons have ears. American Mathematical Monthly 82, 648-651.
[[nodiscard]] std::optional<std::vector<Face>> cut_ears_of_few(std::vector<FlatCorner> rest);

/// The same triangles in the same order, for any number of corners (nothing if one is nowhere): a
/// tree of the corners finds who is in the way, and a corner whose ear is blocked waits until that
/// other one is cut off.
[[nodiscard]] std::optional<std::vector<Face>> cut_ears_of_many(
    const std::vector<FlatCorner>& corners);

}  // namespace quasimc

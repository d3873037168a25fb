#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/mesh/point2.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// A corner projected along the polygon's normal.
struct FlatCorner : Point2 {
    std::size_t index = 0;  ///< index among the given corners
};

[[nodiscard]] inline bool same_point(const FlatCorner& a, const FlatCorner& b) {
    return a.s == b.s && a.t == b.t;
}

/// Whether corners on the border of an ear block it.
enum class Blocking { inside_or_on_border, inside };

/// Whether corner `p` blocks the ear a, b, c, which turns left. Corners at the same point as one of
/// its own do not.
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

/// Cuts a polygon of corners in counter-clockwise order into triangles, one corner at a time: the
/// first without area or, if there is none, the first ear (Meisters, G. H. 1975, Polygons have
/// ears, American Mathematical Monthly 82, 648-651). Nothing if corners remain without an ear.
/// Tests all corners for every ear: for few corners.
[[nodiscard]] std::optional<std::vector<Face>> cut_ears_of_few(std::vector<FlatCorner> rest);

/// Cuts into the same triangles in the same order, for any number of corners (nothing if one is not
/// finite): a tree of the corners finds blocking ones, and a corner whose ear is blocked waits
/// until its blocking corner is cut off.
[[nodiscard]] std::optional<std::vector<Face>> cut_ears_of_many(
    const std::vector<FlatCorner>& corners);

}  // namespace quasimc

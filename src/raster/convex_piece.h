#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/mesh/point2.h"

namespace quasimc {

/// A convex piece of a plane; its corners turn left.
using ConvexPiece = std::vector<Point2>;

[[nodiscard]] double area_of(const ConvexPiece& piece);

/// Length of the line from `from` to `to` within a piece.
[[nodiscard]] double length_within(const ConvexPiece& piece, const Point2& from, const Point2& to);

/// The parts of a piece to the right and to the left of the line through two points.
[[nodiscard]] std::pair<ConvexPiece, ConvexPiece> parts_beside(
    const ConvexPiece& piece, const Point2& from, const Point2& to);

/// The common border of two adjacent pieces, if it is longer than `tolerance`; sides within this
/// distance coincide.
[[nodiscard]] std::optional<PlaneSegment> common_border(
    const ConvexPiece& a, const ConvexPiece& b, double tolerance);

/// The fraction of a segment that coincides with any of others, 0..1.
[[nodiscard]] double share_along(
    const PlaneSegment& segment, std::span<const PlaneSegment> others, double tolerance);

}  // namespace quasimc

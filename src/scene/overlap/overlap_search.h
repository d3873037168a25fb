#pragma once

#include <cstdint>
#include <vector>

#include "geometry/scene_geometry.h"

namespace quasimc {

/// Two coplanar triangles that overlap; `second` is the larger number.
struct Overlap {
    std::uint32_t first, second;
    bool is_same;    ///< the corners are equal within rounding
    bool is_little;  ///< less than a thousandth of the smaller one is covered
};

/// All pairs of triangles of a scene that lie on each other, in order.
struct Overlaps {
    std::vector<Overlap> pairs;
    bool is_skipped = false;  ///< too many triangles for a search
    bool gave_up = false;     ///< too many lie close together to compare all
};

/// Largest number of triangles that are compared.
inline constexpr std::size_t kMaxToCompare = 3'000'000;

/// Largest distance from the plane of a triangle that counts as coplanar: the resolution of single
/// precision, or 1e-6 of the triangle.
[[nodiscard]] double coplanar_tolerance(double triangle_size, double scene_size);

/// Finds the overlaps: two triangles overlap if they are within coplanar_tolerance() of each other,
/// and share a strip wider than it and a millionth of the smaller one. Needs about n log n
/// comparisons.
[[nodiscard]] Overlaps find_overlaps(const SceneGeometry& triangles);

/// Work of a search on pairs of parallel triangles.
struct OverlapWork {
    std::size_t comparisons = 0;  ///< number of coplanar pairs compared
    std::size_t candidates = 0;   ///< number of pairs in parallel planes

    OverlapWork& operator+=(const OverlapWork& other);
    /// Whether a search among this number of triangles must stop. A comparison costs at least as
    /// much as eight candidates.
    [[nodiscard]] bool is_too_much(std::size_t triangles) const;
};

/// Overlaps that a search found, and its work.
struct OverlapSearchResult {
    Overlaps overlaps;
    OverlapWork work;
    /// Largest number of earlier triangles that one triangle equals.
    std::uint32_t most_same = 0;
};

/// A triangle that equals this number of earlier ones is not compared further; the result then
/// depends on the order of the search.
inline constexpr std::uint32_t kPileOfTriangles = 64;

/// find_overlaps() for at most kMaxToCompare triangles, with the work.
[[nodiscard]] OverlapSearchResult search_overlaps(const SceneGeometry& triangles);

/// search_overlaps() restricted to pairs with a changed triangle.
/// @param triangles  without instances; the changed ones, and at least all that lie on them
/// @param changed  by triangle
/// @param scene  bounds of the scene that they are part of
[[nodiscard]] OverlapSearchResult search_overlaps_of(
    const SceneGeometry& triangles, const std::vector<bool>& changed, const Bounds& scene);

}  // namespace quasimc

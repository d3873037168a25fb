#pragma once

#include <cstdint>
#include <vector>

#include "geometry/scene_geometry.h"

namespace quasimc {

/// Two triangles that lie in one plane, one upon the other; `second` is the larger number.
struct Overlap {
    std::uint32_t first, second;
    bool is_same;    ///< the same corners, but for rounding
    bool is_little;  ///< less than a thousandth of the smaller one is covered
};

/// All pairs of triangles of a scene that lie on each other, in order.
struct Overlaps {
    std::vector<Overlap> pairs;
    bool is_skipped = false;  ///< there are too many triangles to look
    bool gave_up = false;     ///< too many lie close together to compare all
};

/// More triangles than that are not compared.
inline constexpr std::size_t kMaxToCompare = 3'000'000;

/// Distance from the plane of a triangle that counts as none: what single precision can't tell, or
/// 1e-6 of the triangle.
[[nodiscard]] double coplanar_tolerance(double triangle_size, double scene_size);

/// Two triangles count as lying on each other where they are no farther apart than that, a strip
/// wider than that is covered and a millionth of the smaller one. Takes some n log n comparisons.
[[nodiscard]] Overlaps find_overlaps(const SceneGeometry& triangles);

/// What a search does with pairs of triangles that face the same way.
struct OverlapWork {
    std::size_t comparisons = 0;  ///< of pairs in one plane
    std::size_t candidates = 0;   ///< at pairs in parallel planes

    OverlapWork& operator+=(const OverlapWork& other);
    /// Whether a search among so many triangles goes no further. To compare two takes as long as
    /// eight looks or more.
    [[nodiscard]] bool is_too_much(std::size_t triangles) const;
};

/// What a search found, and how much work it was.
struct OverlapSearchResult {
    Overlaps overlaps;
    OverlapWork work;
    /// How often a triangle was found to be the same as one before it, at most.
    std::uint32_t most_same = 0;
};

/// A triangle that is the same as that many before it is compared no more: what is found then
/// depends on the order of the search.
inline constexpr std::uint32_t kPileOfTriangles = 64;

/// As find_overlaps, with the work; at most kMaxToCompare triangles.
[[nodiscard]] OverlapSearchResult search_overlaps(const SceneGeometry& triangles);

/// As search_overlaps, but only pairs of which one changed.
/// @param triangles  without instances; the changed ones, and at least all that lie on them
/// @param changed  of each triangle
/// @param scene  bounds of the scene that they are part of
[[nodiscard]] OverlapSearchResult search_overlaps_of(
    const SceneGeometry& triangles, const std::vector<bool>& changed, const Bounds& scene);

}  // namespace quasimc

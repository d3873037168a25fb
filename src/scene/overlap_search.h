#pragma once

#include <cstdint>
#include <vector>

#include "geometry/scene_geometry.h"

namespace quasimc {

/// Two triangles that lie in one plane, one upon the other; `second` is the larger number.
struct Overlap {
    std::uint32_t first, second;
    bool is_same;  ///< the same corners, but for rounding
};

/// All pairs of triangles of a scene that lie on each other, in order.
struct Overlaps {
    std::vector<Overlap> pairs;
    bool is_left_out = false;  ///< there are too many triangles to look
    bool gave_up = false;      ///< too many lie close together to compare all
};

/// More triangles than that are not compared.
inline constexpr std::size_t kMostToCompare = 3'000'000;

/// Distance from the plane of a triangle that counts as none: what single precision can't tell, or
/// 1e-6 of the triangle.
[[nodiscard]] double coplanar_tolerance(double triangle_size, double scene_size);

/// Two triangles count as lying on each other where they are no farther apart than that and a
/// thousandth of the smaller one is covered. Takes some n log n comparisons.
[[nodiscard]] Overlaps find_overlaps(const SceneGeometry& triangles);

}  // namespace quasimc

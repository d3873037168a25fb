#pragma once

#include <cstdint>
#include <vector>

#include "geometry/cast/intersector.h"
#include "quasimc/mesh.h"

namespace quasimc::bench {

/// `count` equilateral triangles of random position and orientation in the unit cube, of total area
/// `area`.
[[nodiscard]] std::vector<Triangle> random_leaves(std::size_t count, double area);

/// Sixteen plants of `leaves` triangles each on the unit square, half a unit high, of leaf area
/// index 1. Some of the leaves reach over the square's border.
[[nodiscard]] std::vector<Triangle> plants(std::size_t leaves);

struct BenchRay {
    Vec3 origin, direction;
    std::uint32_t self = kNoTriangle;
};

/// Straight down from the top of the unit square at `height`; along a Morton curve if `ordered`.
[[nodiscard]] std::vector<BenchRay> vertical_rays(std::size_t count, double height, bool ordered);
/// Rays down from the same points, with directions like those of a uniform sky's light.
[[nodiscard]] std::vector<BenchRay> sky_rays(std::size_t count, double height);
/// Rays down from the same points, ten degrees below the horizontal.
[[nodiscard]] std::vector<BenchRay> low_rays(std::size_t count, double height);
/// Rays from random points on random triangles, with directions like those of scattered light.
[[nodiscard]] std::vector<BenchRay> leaf_rays(
    std::size_t count, const std::vector<Triangle>& triangles);

/// Sixteen of the rays, from `first`.
[[nodiscard]] Packet packet_of(const std::vector<BenchRay>& rays, std::size_t first);

}  // namespace quasimc::bench

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "statistical/scenes.h"

// Random canopies of tiny leaves, close to a turbid medium.

namespace quasimc::test {

/// Leaves of one size, turned all ways, above a soil; infinite: a periodic cell of half the
/// canopy's height.
struct CanopySpec {
    std::size_t leaves = 4000;
    double leaf_area_index = 1;
    MaterialSpec leaf, soil;
};

/// Organ 0 is all leaves, organ 1 the soil; the cell has an area of kCellArea.
[[nodiscard]] Scene make_canopy(const CanopySpec& spec, std::uint64_t seed);
inline constexpr double kCellArea = .25;
inline constexpr std::size_t kCanopy = 0;
inline constexpr std::size_t kSoil = 1;

/// A spherical crown of radius 0.5 full of black leaves, of which `leaves` would fill the cube
/// around it.
/// @param depth  k times the diameter, k the extinction coefficient
[[nodiscard]] Scene make_crown(std::size_t leaves, double depth, std::uint64_t seed);

/// One run of one replicate, seeded like its canopy.
[[nodiscard]] Result trace_once(
    const Scene& scene,
    const Sources& sources,
    Method from,
    std::uint64_t paths,
    std::uint64_t seed);

/// Quantities measured once for each seed 1, 2, ..., each averaged over the seeds.
[[nodiscard]] std::vector<Measured> over_seeds(
    unsigned seeds, const std::function<std::vector<double>(std::uint64_t seed)>& numbers);

}  // namespace quasimc::test

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/ray_bundles/patch_scene.h"

namespace quasimc {

/// Areas of regions as the lines of one step met them.
struct MetAreas {
    std::vector<double> found;        ///< by region
    std::vector<double> corrections;  ///< by region: true over found area; 1 where lines are few
    std::vector<bool> is_corrected;   ///< by region
};

/// Sums what lines met of each region. Light that came along them to a region is to be multiplied
/// by its correction, a ratio estimate.
/// @param found  area of each surface of the scene, in their order
/// @param lines_per_area  of the step, in the mean
[[nodiscard]] MetAreas met_areas(
    const PatchScene& scene, std::span<const double> found, double lines_per_area);

/// What the lines of a step met.
struct LineStatistics {
    MetAreas areas;
    /// Area by 2 * region + side from which lines left towards the sky (solvers/ray_bundles/
    /// sky_view.h); empty if it was not asked for.
    std::vector<double> open;
    std::uint64_t segments = 0;  ///< along which light went
};

}  // namespace quasimc

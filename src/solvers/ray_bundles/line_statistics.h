#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/ray_bundles/patch_scene.h"

namespace quasimc {

/// Areas of regions as estimated by the lines of one step.
struct MetAreas {
    std::vector<double> found;        ///< by region
    std::vector<double> corrections;  ///< by region: true over estimated area; 1 for few lines
    std::vector<bool> is_corrected;   ///< by region
};

/// Sums the area of each region that lines met. The light along these lines is to be multiplied by
/// the correction of its region, a ratio estimate.
/// @param found  area of each surface of the scene, in their order
/// @param lines_per_area  mean number in the step
[[nodiscard]] MetAreas met_areas(
    const PatchScene& scene, std::span<const double> found, double lines_per_area);

/// Statistics of the lines of a step.
struct LineStatistics {
    MetAreas areas;
    /// Area by 2 * region + side from which lines left towards the sky (solvers/ray_bundles/
    /// sky_view.h); empty unless requested.
    std::vector<double> open;
    std::uint64_t segments = 0;  ///< along which light went
};

}  // namespace quasimc

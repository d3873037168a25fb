#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "quasimc/result.h"
#include "scene/scene.h"

namespace quasimc {

/// Whether an organ's light is summed with that of others.
[[nodiscard]] bool is_counted(const Organ& organ);
/// Whether an organ is part of the canopy, and so of layers: counted, and no sensor.
[[nodiscard]] bool is_plant(const Scene& scene, const Organ& organ);

/// Height of an organ.
struct OrganHeight {
    double centroid = 0;  ///< mean over its area, or over its triangles if it has no area
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};
/// Takes time proportional to the triangles of the organ.
[[nodiscard]] OrganHeight height_of(const Scene& scene, const Organ& organ);

/// The boundaries of the layers that groups request, ascending; fewer than two: no layers. Equal
/// layers do not ascend where the organs have no height.
[[nodiscard]] std::vector<double> layer_boundaries(const Scene& scene, const GroupSpec& spec);
/// The layer that contains a height, from 0 below; empty outside. The last one contains its upper
/// boundary.
[[nodiscard]] std::optional<std::size_t> layer_at(
    const std::vector<double>& boundaries, double height);

}  // namespace quasimc

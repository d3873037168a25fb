#pragma once

// What sums of tracing from the organs count: units by region.

#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "transport/near_lamps.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Points a block holds: of one organ, or of several if they have few each.
inline constexpr std::uint64_t kOrganPointsPerBlock = 8192;
/// Steps of the fixed point are finer by this: weights of big organs are small (2^40 steps a unit).
inline constexpr double kOrganGain = 4096;

/// The organs that points are placed on, and the area of all of them.
struct MeasuredArea {
    std::vector<std::uint32_t> organs;
    double area = 0;
};

[[nodiscard]] MeasuredArea measured_area(const Scene& scene);

/// From the flux of a light path to units of a region.
[[nodiscard]] double units_of_light_path(const MeasuredArea& measured, double own_area);

/// By region, how much coarser its units are, a power of two; 1 for all but the smallest organs. A
/// light path brings an organ the more units the smaller it is: of as many as this all paths of a
/// block may meet one.
[[nodiscard]] std::vector<double> coarseness_of(const Scene& scene, const MeasuredArea& measured);

/// Whether points do not look for all light.
[[nodiscard]] bool needs_light_paths(const PreparedScene& prepared, const NearLamps& near);

}  // namespace quasimc

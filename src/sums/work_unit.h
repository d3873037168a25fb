#pragma once

#include <cstddef>
#include <cstdint>

namespace quasimc {

/// Units of the work of a run, which methods count where they do it. Counts are the same on every
/// machine; planner/work_cost.h weighs them.
enum class WorkUnit : std::uint8_t {
    ray,              ///< cast into the scene
    strip_triangle,   ///< triangle that a strip of scan lines may meet
    piece,            ///< visible segment of a scan line, or its part on a patch
    viewed_triangle,  ///< triangle drawn in an item buffer
    pixel,            ///< pixel of an item buffer
    patch_pixel,      ///< pixel whose light is deposited on a patch
    lined_triangle,   ///< triangle drawn for a direction of a ray bundle
    segment,          ///< line of a bundle between two surfaces
    patch,            ///< patch that scatters light of an order, for each band
};
inline constexpr std::size_t kWorkUnits = 9;

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/triangle_block.h"

namespace quasimc {

/// Number of pixels drawn at a time: depths and ids need room for this many beyond their end.
inline constexpr std::int32_t kSpanLanes = 8;

/// A depth buffer, row by row.
struct DepthBuffer {
    float* depths = nullptr;
    std::int32_t* ids = nullptr;  ///< of the nearest object; of equally near ones the smallest
    std::uint32_t columns = 1;
};

/// Loops over pixels, compiled for a vector unit.
struct DrawLoops {
    /// Draws the current rows of a block with depth test: its lanes are objects `first_id`,
    /// `first_id + 1`, ...
    void (*rows)(const DepthBuffer& to, const BlockSpans& spans, std::int32_t first_id);
    /// Writes the end of each run of equal ids among the first `count`; ids[count] may differ too.
    /// `ends` must have room for `count`. @returns the number of runs
    std::size_t (*run_ends)(const std::int32_t* ids, std::uint32_t count, std::uint32_t* ends);
};

/// The loops for the vector unit of this machine. All variants compute the same bits.
[[nodiscard]] DrawLoops best_draw_loops();

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "raster/triangle_block.h"

namespace quasimc {

/// So many pixels are drawn at one go: depths and ids need room for as many behind their end.
inline constexpr std::int32_t kSpanLanes = 8;

/// Pixels of a row next to each other.
struct PixelSpan {
    std::size_t first = 0;
    std::int32_t count = 0;
    float z = 0;  ///< depth at the first
};

/// A depth buffer, row by row.
struct DepthBuffer {
    float* depths = nullptr;
    std::int32_t* ids = nullptr;  ///< of what is nearest; of what is equally near the least
    std::uint32_t columns = 1;
};

/// Loops over pixels, compiled for a vector unit.
struct DrawLoops {
    /// Draws spans of object `id`, whose depth rises by `step` from pixel to pixel, where they are
    /// nearer than what is there.
    void (*spans)(
        const DepthBuffer& to, std::span<const PixelSpan> spans, float step, std::int32_t id);
    /// Draws the rows at hand of a block: its lanes are objects `first_id`, `first_id + 1`, ...
    void (*rows)(const DepthBuffer& to, const BlockSpans& spans, std::int32_t first_id);
    /// Writes behind which of the first `count` ids another stands: the number of the other, which
    /// ids[count] may be. There must be room for `count`. @returns how many
    std::size_t (*run_ends)(const std::int32_t* ids, std::uint32_t count, std::uint32_t* ends);
};

/// Those for the vector unit of this machine. All variants compute the same bits.
[[nodiscard]] DrawLoops best_draw_loops();

}  // namespace quasimc

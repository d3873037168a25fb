#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace quasimc {

/// So many pixels are drawn at one go: depths and ids need room for as many behind their end.
inline constexpr std::int32_t kSpanLanes = 8;

/// Pixels of a row next to each other.
struct PixelSpan {
    std::size_t first = 0;
    std::int32_t count = 0;
    float z = 0;  ///< depth at the first
};

/// Draws spans of object `id`, whose depth rises by `step` from pixel to pixel, into a depth
/// buffer, where they are nearer than what is there.
using DrawSpans = void(
    float* depths,
    std::int32_t* ids,
    std::span<const PixelSpan> spans,
    float step,
    std::int32_t id);

/// The variant for the vector unit of this machine. All variants compute the same bits.
[[nodiscard]] DrawSpans* best_draw_spans();

}  // namespace quasimc

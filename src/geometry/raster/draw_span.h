#pragma once

#include <cstdint>

namespace quasimc {

/// So many pixels are drawn at one go: depths and ids need room for as many behind their end.
inline constexpr std::int32_t kSpanLanes = 8;

/// Draws `count` pixels next to each other of depth z, z + step, ... and of object `id` into a
/// depth buffer, where they are nearer than what is there.
using DrawSpan = void(
    float* depths, std::int32_t* ids, std::int32_t count, float z, float step, std::int32_t id);

/// The variant for the vector unit of this machine. All variants compute the same bits.
[[nodiscard]] DrawSpan* best_draw_span();

}  // namespace quasimc

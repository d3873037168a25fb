#pragma once

#include <array>
#include <cstdint>

namespace quasimc {

/// A side of a surface: the upper one is that from which the corners of its triangles run
/// counter-clockwise.
enum class SurfaceSide : std::uint8_t { upper, lower };

inline constexpr std::array<SurfaceSide, 2> kSurfaceSides{SurfaceSide::upper, SurfaceSide::lower};

/// 0 for the upper side, 1 for the lower.
[[nodiscard]] constexpr std::size_t index_of(SurfaceSide side) {
    return static_cast<std::size_t>(side);
}

[[nodiscard]] constexpr SurfaceSide opposite(SurfaceSide side) {
    return side == SurfaceSide::upper ? SurfaceSide::lower : SurfaceSide::upper;
}

/// The side that light meets which travels along a direction.
/// @param along  dot(normal of the upper side, direction)
[[nodiscard]] constexpr SurfaceSide side_facing(double along) {
    return along < 0 ? SurfaceSide::upper : SurfaceSide::lower;
}

}  // namespace quasimc

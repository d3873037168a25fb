#pragma once

#include <string>

#include "scene/scene.h"

namespace quasimc {

/// About which places of the page stand, z up.
[[nodiscard]] Vec3 window_middle(const Scene& scene);

/// The triangles of all organs as the page takes them, little-endian numbers in single precision:
/// areas of organs, heights of their middles, how many triangles they have (32 bits), places
/// (three numbers each, about window_middle()), and a byte for each corner, organ by organ: 0 is
/// the next place, k the k-th last of those that have been. Places are of one organ alone.
/// @returns 12 bytes an organ, 12 a place and 3 a triangle
[[nodiscard]] std::string window_shape(const Scene& scene);

}  // namespace quasimc

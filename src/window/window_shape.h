#pragma once

#include <string>

#include "scene/scene.h"

namespace quasimc {

/// The origin of the page's coordinates, z up.
[[nodiscard]] Vec3 window_middle(const Scene& scene);

/// The triangles of all organs for the page, little-endian numbers in single precision:
/// areas of organs, heights of their middles, how many triangles they have (32 bits), vertices
/// (three numbers each, about window_middle()), and a byte for each corner, organ by organ: 0 is
/// the next vertex, k the k-th last vertex before. Organs share no vertices.
/// @returns 12 bytes per organ, 12 per vertex and 3 per triangle
[[nodiscard]] std::string window_shape(const Scene& scene);

}  // namespace quasimc

#pragma once

#include <cstddef>

#include "geometry/mesh/mesh.h"
#include "scene/scene.h"

namespace quasimc {

/// How often a mesh must be used, and how many triangles it must have, to be kept once for all its
/// copies (OrganPart::shared). Copies of others are stored like any triangles, which is faster to
/// trace.
inline constexpr std::size_t kFewestCopies = 3;
inline constexpr std::size_t kSmallestPrototype = 64;

}  // namespace quasimc

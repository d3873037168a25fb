#pragma once

#include <span>

#include "quasimc/mesh.h"

namespace quasimc {

/// Whether triangles are a surface without a rim, through which no light gets in: each edge is
/// passed as often in one direction as in the other. Corners that differ by rounding are the same.
[[nodiscard]] bool is_closed(std::span<const Triangle> triangles);

}  // namespace quasimc

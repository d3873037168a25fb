#pragma once

#include <optional>

#include "quasimc/mesh.h"
#include "quasimc/scene.h"

namespace quasimc {

/// The highest point of a ground at (x, y), z up; empty if there is none. A horizontal ground has
/// no end. Takes time proportional to the triangles.
[[nodiscard]] std::optional<double> ground_height(
    const GroundSpec& ground, const Orientation& orientation, double x, double y);

}  // namespace quasimc

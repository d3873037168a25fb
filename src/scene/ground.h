#pragma once

#include "quasimc/error.h"
#include "quasimc/mesh.h"
#include "scene/scene.h"

namespace quasimc {

/// The ground as an organ without id, z up. Adds the faults of the specification, and of a
/// horizontal ground that does not fit the cell or the organs.
/// @param organs  bounds of the organs, z up; may be empty
[[nodiscard]] OrganSpec make_ground_organ(
    GroundSpec ground, const Cell& cell, const Bounds& organs, Faults& faults);

}  // namespace quasimc

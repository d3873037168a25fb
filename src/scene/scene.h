#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/mesh/cell.h"
#include "geometry/scene_geometry.h"
#include "optics/material.h"
#include "quasimc/scene.h"

namespace quasimc {

/// Which materials an organ is made of, by MaterialId. The others must change nothing.
[[nodiscard]] std::vector<bool> used_materials(const Scene& scene);

/// Per band, the largest albedo in [0, 1] of a surface in use that is no sensor.
[[nodiscard]] std::vector<double> largest_albedos(const Scene& scene);

}  // namespace quasimc

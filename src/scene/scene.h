#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/common_memory.h"
#include "geometry/mesh/cell.h"
#include "geometry/scene_geometry.h"
#include "optics/material.h"
#include "quasimc/scene.h"

namespace quasimc {

/// Which materials an organ is made of, by MaterialId. The others must change nothing.
[[nodiscard]] std::vector<bool> used_materials(const Scene& scene);

/// The same scene, with what there is of large arrays in common memory, and what is made of them.
[[nodiscard]] Scene in_common_memory(Scene scene, const std::shared_ptr<CommonMemory>& common);

/// Per band, the largest albedo in [0, 1] of a surface in use that is no sensor.
[[nodiscard]] std::vector<double> largest_albedos(const Scene& scene);

}  // namespace quasimc

#pragma once

#include "scene/scene.h"

namespace quasimc::stress {

/// Whether surfaces are so close, or cross at so small an angle, that single precision can't
/// determine the front one, without being coplanar for the program: within 4e-6 of the scene.
/// Rounding then decides which of them receives the light.
[[nodiscard]] bool has_near_surfaces(const Scene& scene);

}  // namespace quasimc::stress

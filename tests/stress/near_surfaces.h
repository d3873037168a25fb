#pragma once

#include "scene/scene.h"

namespace quasimc::stress {

/// Whether surfaces lie on each other, or cross at so small an angle, that single precision does
/// not tell which of them is in front, but not so nearly in one plane that the program takes them
/// as one: within 4e-6 of the scene. What each of them gets is then left to rounding.
[[nodiscard]] bool has_near_surfaces(const Scene& scene);

}  // namespace quasimc::stress

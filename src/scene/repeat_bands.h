#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace quasimc {

/// The same surfaces in `times` as many wavebands: those of the scene, one set after the other, so
/// that several lights are told apart in one run. Without detectors.
[[nodiscard]] Scene with_repeated_bands(const Scene& scene, std::size_t times);

}  // namespace quasimc

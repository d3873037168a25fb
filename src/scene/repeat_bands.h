#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace quasimc {

/// A scene with each waveband repeated `times` times, so that one run separates several lights.
/// Without detectors.
[[nodiscard]] Scene with_repeated_bands(const Scene& scene, std::size_t times);

/// Index of a copy of a band in with_repeated_bands().
[[nodiscard]] constexpr std::size_t repeated_band(
    std::size_t band, std::size_t copy, std::size_t times) {
    return band * times + copy;
}

}  // namespace quasimc

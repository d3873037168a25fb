#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace quasimc {

/// The same surfaces in `times` as many wavebands, each several times in a row, so that several
/// lights are told apart in one run. Without detectors.
[[nodiscard]] Scene with_repeated_bands(const Scene& scene, std::size_t times);

/// Which band of with_repeated_bands() a copy of a band is.
[[nodiscard]] constexpr std::size_t repeated_band(
    std::size_t band, std::size_t copy, std::size_t times) {
    return band * times + copy;
}

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <vector>

#include "optics/side.h"

namespace quasimc {

/// Reflectance and transmittance of a side of a material, per band.
struct PatchOptics {
    std::vector<double> reflected, transmitted;
};

/// The optics of a Lambertian side.
[[nodiscard]] inline PatchOptics optics_of(const Side& side, std::size_t bands) {
    PatchOptics optics{std::vector<double>(bands), std::vector<double>(bands)};
    for (const Lobe& lobe : side.lobes()) {
        const bool is_reflected = lobe.shape->hemisphere() == Hemisphere::reflected;
        for (std::size_t b = 0; b < bands; ++b) {
            (is_reflected ? optics.reflected : optics.transmitted)[b] += lobe.albedo[b];
        }
    }
    return optics;
}

}  // namespace quasimc

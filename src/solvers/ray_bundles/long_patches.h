#pragma once

#include <vector>

#include "scene/scene.h"
#include "solvers/ray_bundles/patch_size.h"

// Patches of long thin triangles are long and thin as well. Light that changes along them, as it
// does within a stem or between needles, is averaged over them in all replicates, so that the
// reported error does not show this.

namespace quasimc {

/// Organs of such triangles, if their patches are longer than the organ is wide.
struct LongPatches {
    /// Organs with unreliable reported errors. A small fraction of flat and closed organs is
    /// tolerated.
    std::vector<const Organ*> organs;
    /// Fraction of all surfaces in closed organs, such as stems. Their error is reported, but does
    /// not decrease with more paths.
    double closed_part = 0;
};

/// Takes time in proportion to the triangles.
[[nodiscard]] LongPatches find_long_patches(const Scene& scene, const PatchSize& size);

}  // namespace quasimc

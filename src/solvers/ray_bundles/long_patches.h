#pragma once

#include <vector>

#include "scene/scene.h"
#include "solvers/ray_bundles/patch_size.h"

// Patches of long thin triangles are long and thin as well: light that changes along them, as it
// does within a stem or between needles, is lost in both levels of patches, so that their
// difference, the error of patches, tells nothing of it.

namespace quasimc {

/// Organs of such triangles, where they make patches longer than the organ is wide.
struct LongPatches {
    /// Those whose errors don't tell what is wrong. Of flat and closed ones there may be some.
    std::vector<const Organ*> organs;
    /// Of all surfaces, what is in closed ones, as stems are. What is wrong there is told, but does
    /// not get less with more paths.
    double closed_part = 0;
};

/// Takes time in proportion to the triangles.
[[nodiscard]] LongPatches find_long_patches(const Scene& scene, const PatchSize& size);

}  // namespace quasimc

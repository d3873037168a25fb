#pragma once

#include "scene/scene.h"

namespace quasimc {

/// The size of the patches of ray bundles.
struct PatchSize {
    double area = 0;   ///< total area of surfaces
    double part = 1;   ///< approximate fraction of it in a patch
    double count = 1;  ///< approximate number of patches
    /// Whether patches are small enough to resolve the shadow of a typical organ.
    bool holds_shadows = true;
    /// Whether no patches of small organs are too small for lines to meet them often: very few
    /// lines would sample the light that such patches exchange.
    bool are_alike = true;
};

/// Level of subdivision of a triangle, at least 1: it is cut into 4^level similar parts of about
/// the area `patch`.
[[nodiscard]] int patch_level(double area, double patch);

/// Sizes for about `most` patches. More are made, up to four times the minimum of all triangles, to
/// resolve shadows of organs on much larger surfaces, such as a ground.
[[nodiscard]] PatchSize patch_size(const Scene& scene, double most);

}  // namespace quasimc

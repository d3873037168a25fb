#pragma once

#include "scene/scene.h"

namespace quasimc {

/// How large the patches of ray bundles are.
struct PatchSize {
    double area = 0;   ///< of all surfaces
    double part = 1;   ///< of that: what a patch covers, about
    double count = 1;  ///< of patches, about
    /// Whether none is so large beside a typical organ that the shadow of one is lost in it.
    bool holds_shadows = true;
    /// Whether those of small organs are not so much smaller than the rest that lines hardly ever
    /// meet one: light that goes to and fro between them would be found by very few lines.
    bool are_alike = true;
};

/// A triangle of this area is cut into 4 to the power of so many similar parts, for patches of
/// about a given area; once at least.
[[nodiscard]] int patch_level(double area, double patch);

/// About `most` patches; more where surfaces are large beside organs, as a ground below leaves is,
/// so that the shadows of organs are told apart, as long as that makes at most four times as many
/// as triangles are cut into anyway.
[[nodiscard]] PatchSize patch_size(const Scene& scene, double most);

}  // namespace quasimc

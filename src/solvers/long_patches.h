#pragma once

#include <vector>

#include "quasimc/run_spec.h"
#include "scene/scene.h"
#include "solvers/patch_size.h"

// Patches of long thin triangles are long and thin as well: light that changes along them, as it
// does within a stem or between needles, is lost in both levels of patches, so that their
// difference, the error of patches, tells nothing of it.

namespace quasimc {

/// Whether some organ has such triangles, and they make patches longer than it is wide. Of flat
/// ones there may be a few. Takes time in proportion to the triangles.
[[nodiscard]] bool has_long_patches(const Scene& scene, const PatchSize& size);

/// What ray bundles that are asked for by name get wrong without telling; nothing of other methods.
[[nodiscard]] std::vector<Warning> lint_bundles(const Scene& scene, const RunSpec& spec);

}  // namespace quasimc

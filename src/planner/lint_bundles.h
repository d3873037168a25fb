#pragma once

#include <vector>

#include "light/models/source.h"
#include "quasimc/run_spec.h"
#include "scene/scene.h"

// What ray bundles that are asked for by name get wrong without telling: light that changes within
// patches on both of their levels. Nothing of other methods, and nothing where "auto" takes
// bundles.

namespace quasimc {

/// Of surfaces of long thin triangles, patches too large beside organs, and of lamps amid or next
/// to surfaces.
[[nodiscard]] std::vector<Warning> lint_bundles(
    const Scene& scene, const Sources& sources, const RunSpec& spec);

}  // namespace quasimc

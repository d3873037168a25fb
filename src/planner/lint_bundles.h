#pragma once

#include <vector>

#include "light/models/source.h"
#include "quasimc/run_spec.h"
#include "scene/scene.h"

// Warnings about errors that ray bundles do not report: light that changes within patches on both
// of their levels. They concern ray bundles that were requested by name, if "auto" would not choose
// them.

namespace quasimc {

/// Warns of surfaces of long thin triangles, of patches that are too large for organs, and of lamps
/// between or next to surfaces.
[[nodiscard]] std::vector<Warning> lint_bundles(
    const Scene& scene, const Sources& sources, const RunSpec& spec);

}  // namespace quasimc

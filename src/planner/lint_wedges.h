#pragma once

#include <vector>

#include "light/models/source.h"
#include "scene/scene.h"

// What every method gets wrong without telling: light in wedges narrower than rays resolve.

namespace quasimc {

/// Of lamps within 1e-4 of the scene of a place where surfaces touch at a small angle: where they
/// are brightest these are nearer to each other than rays reach.
[[nodiscard]] std::vector<Warning> lint_wedges(const Scene& scene, const Sources& sources);

}  // namespace quasimc

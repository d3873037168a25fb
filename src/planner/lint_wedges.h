#pragma once

#include <vector>

#include "light/models/source.h"
#include "scene/scene.h"

// Warnings about an error that no method reports: light in wedges narrower than rays resolve.

namespace quasimc {

/// Warns of lamps within 1e-4 of the scene size of a point where surfaces touch at a small angle:
/// where these are brightest, they are closer to each other than rays resolve.
[[nodiscard]] std::vector<Warning> lint_wedges(const Scene& scene, const Sources& sources);

}  // namespace quasimc

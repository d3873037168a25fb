#pragma once

#include <vector>

#include "light/models/source.h"
#include "scene/scene.h"

namespace quasimc {

/// The origin of a scene's unit of length.
enum class UnitOrigin { given, assumed };

/// Warns of a unit of length that was assumed, and of plants of unlikely size, as the light of
/// lamps depends on the unit: a median organ above 2 m, all organs together below 5 mm.
[[nodiscard]] std::vector<Warning> lint_lamp_unit(
    const Scene& scene, const Sources& sources, UnitOrigin origin);

/// Warns of lamps below a horizontal ground.
[[nodiscard]] std::vector<Warning> lint_lamp_positions(const Scene& scene, const Sources& sources);

}  // namespace quasimc

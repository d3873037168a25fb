#pragma once

#include <vector>

#include "light/models/source.h"
#include "scene/scene.h"

namespace quasimc {

/// Where a scene has its unit of length from.
enum class UnitOrigin { given, assumed };

/// The light of lamps, unlike that of suns and skies, depends on how long the unit of length is. It
/// warns of a unit that was assumed, and of plants whose size is strange in it: a median organ
/// above 2 m, all organs together below 5 mm.
[[nodiscard]] std::vector<Warning> lint_lamp_unit(
    const Scene& scene, const Sources& sources, UnitOrigin origin);

/// Lamps below a horizontal ground.
[[nodiscard]] std::vector<Warning> lint_lamp_positions(const Scene& scene, const Sources& sources);

}  // namespace quasimc

#pragma once

#include <optional>

#include "light/models/source.h"

namespace quasimc {

/// The centre of a lamp that shines on the centre of the scene's box; none for other sources.
[[nodiscard]] std::optional<Vec3> position_of_lamp(const Source& source, const Bounds& bounds);

/// Whether a source is a lamp that is in the scene's box, does not shine on its centre, or gives a
/// much larger irradiance at the nearest point of the box than at its centre or half way from there
/// to a corner.
[[nodiscard]] bool is_near_lamp(const Source& source, const Bounds& bounds);

}  // namespace quasimc

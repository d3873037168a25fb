#pragma once

#include <optional>

#include "light/models/source.h"

namespace quasimc {

/// The middle of a lamp that shines on the middle of the scene's box; none of other sources.
[[nodiscard]] std::optional<Vec3> position_of_lamp(const Source& source, const Bounds& bounds);

/// Whether a source is a lamp that is in the scene's box, does not shine on its middle, or shines
/// much more brightly on the point of the box next to it than on its middle or half way
/// from there to a corner.
[[nodiscard]] bool is_near_lamp(const Source& source, const Bounds& bounds);

}  // namespace quasimc

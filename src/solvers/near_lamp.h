#pragma once

#include "sources/source.h"

namespace quasimc {

/// Whether a source is a lamp that is in the scene's box, does not shine on its middle, or shines
/// much more brightly on the place of the box that is next to it than on its middle or half way
/// from there to a corner.
[[nodiscard]] bool is_near_lamp(const Source& source, const Bounds& bounds);

}  // namespace quasimc

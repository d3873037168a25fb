// A mirror, or a clear pane: all light in one direction.
//
// Model    Reflected light leaves along the mirror image of wi, transmitted light straight on (no
// refraction: leaves are thin). A delta lobe has no density; it is sampled, never evaluated. Theory
// docs/theory/leaf-and-soil-models.md
#pragma once

#include <memory>

#include "optics/bsdf.h"

namespace quasimc {

/// The model `mirror` of the catalogue.
[[nodiscard]] std::unique_ptr<Bsdf> make_mirror(Hemisphere hemisphere);

}  // namespace quasimc

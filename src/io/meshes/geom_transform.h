#pragma once

#include <optional>

#include "io/meshes/geom_text.h"
#include "quasimc/vec3.h"

namespace quasimc {

/// What a transforming object of a .geom file does to the geometry in it: Translated, Scaled,
/// AxisRotated, EulerRotated, Oriented; angles are in degrees. Nothing after a fault, as which an
/// object of another type counts.
[[nodiscard]] std::optional<Affine> geom_transform(const GeomObject& object, Reporter& reporter);

}  // namespace quasimc

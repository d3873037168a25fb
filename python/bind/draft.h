#pragma once

#include "bind.h"
#include "scene.h"

namespace quasimc::python {

/// The organs of shapes and files of a document, before their overlaps are cut away: a dict with
/// triangles (n, 3, 3), material_of_triangle (n,) among material_names, starts (organs + 1,), and
/// by organ measured, field_of_view_deg and labels; and optics, name of a material -> (reflectance,
/// transmittance) by band.
[[nodiscard]] py::dict draft_of(const Document& document);

}  // namespace quasimc::python

#pragma once

#include "quasimc/mesh.h"

namespace quasimc {

/// Renumbers the vertices in the order in which the faces name them first; those that no face names
/// are left out.
void order_vertices(Mesh& mesh);

}  // namespace quasimc

#pragma once

#include "quasimc/mesh.h"

namespace quasimc {

/// Renumbers the vertices in the order of their first use by faces; unused ones are dropped.
void order_vertices(Mesh& mesh);

}  // namespace quasimc

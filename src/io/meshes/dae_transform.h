#pragma once

#include <cstddef>
#include <optional>

#include "io/meshes/dae_library.h"
#include "quasimc/vec3.h"

namespace quasimc {

/// What the transforms in a <node> do together, the last one first: <matrix>, <translate>,
/// <rotate>, <scale>, <lookat>. Nothing after a fault, as which <skew> counts.
[[nodiscard]] std::optional<Affine> dae_transform(
    const XmlTree& tree, std::size_t node, DaeLibrary& library);

/// From the axes and the unit that the <asset> of a file states, or the usual ones (y up, metres),
/// to those of the scene.
[[nodiscard]] Affine dae_axes(const XmlTree& tree, DaeLibrary& library, FormatContext& context);

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace quasimc::bench {

/// Leaves of 1,000 triangles each, which share 21 x 26 points.
[[nodiscard]] Scene leaves(std::size_t count);

/// The triangles of a scene in a writable format, or as OPF.
[[nodiscard]] std::string text_of(std::string_view format, const Scene& scene);

}  // namespace quasimc::bench

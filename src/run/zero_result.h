#pragma once

#include "quasimc/run.h"

namespace quasimc {

/// The result of a scene into which no source sends light: what is known of it is exact.
[[nodiscard]] Result unlit_result(const Scene& scene, const RunSpec& spec);

/// Adds sunlit fractions of 0 where a sun shines to which all of the scene is edge-on.
void add_sunlit_of_hidden_suns(const Scene& scene, const Sources& sources, Result& result);

}  // namespace quasimc

#pragma once

#include "quasimc/run.h"

namespace quasimc {

/// The result of a scene without light: it is exact.
[[nodiscard]] Result unlit_result(const Scene& scene, const RunSpec& spec);

/// Adds sunlit fractions of 0 where a sun shines and the whole scene is edge-on to it.
void add_sunlit_of_hidden_suns(const Scene& scene, const Sources& sources, Result& result);

}  // namespace quasimc

#pragma once

#include <cstddef>

#include "quasimc/sums.h"

namespace quasimc {

/// The sums of all origins of light together, as a run that does not keep them apart has them.
[[nodiscard]] Sums of_all_origins(const Sums& sums);

/// The sums of the light of one origin, as a run has them in which the other sources are dark.
/// Their sunlit area is not known apart: 0.
[[nodiscard]] Sums of_origin(const Sums& sums, std::size_t origin);

}  // namespace quasimc

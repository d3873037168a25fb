#pragma once

#include <span>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"
#include "sums/statistics.h"

namespace quasimc {

/// Tells of what organs and the ground absorb in all, in the budget and as fractions of the canopy,
/// what the replicates do not show: how much may be there where nothing was found, what a find more
/// or less changes, and that it is not more than what is emitted.
/// @param finds  [organ][band], of what an organ absorbs; 0 where one more changes nothing
void tell_errors_of_totals(
    const Sums& sums, const Scene& scene, std::span<const SingleFind> finds, Result& result);

}  // namespace quasimc

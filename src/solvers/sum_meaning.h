#pragma once

#include <cstddef>

#include "quasimc/sums.h"

namespace quasimc {

/// What the bins of a solver mean.
struct SumMeaning {
    SumUnits units;
    MeasuredOrgans measured = MeasuredOrgans::all;
    UnoccludedLight unoccluded_light = UnoccludedLight::left_out;
    std::size_t counted_kinds = 0;  ///< SumLayout::counted_kinds
    PatchLevels patch_levels = PatchLevels::none;
};

}  // namespace quasimc

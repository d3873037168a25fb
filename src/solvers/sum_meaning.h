#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "sums/sum_data.h"

namespace quasimc {

/// A solver's declarations about its sums: see SumData.
struct SumMeaning {
    SumUnits units;
    std::vector<ContributionBound> bounds = {};
    std::vector<SamplingStrategy> strategies = {};
    SumBlocks blocks = {};  ///< its own, beside light_blocks()
    MeasuredOrgans measured = MeasuredOrgans::all;

    /// The bound of a quantity, which must be declared.
    [[nodiscard]] ContributionBound& bound(std::string_view quantity) {
        return *std::ranges::find(bounds, quantity, &ContributionBound::quantity);
    }
};

}  // namespace quasimc

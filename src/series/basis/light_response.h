#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "quasimc/sums.h"
#include "series/basis/bin_index.h"
#include "solvers/direct/sun_pixels.h"

namespace quasimc {

/// What one light brings, apart from noise linear in its amount.
struct LightResponse {
    /// [replicate][BinIndex]: flux; of what is sunlit, area
    std::vector<std::vector<float>> bins;
    std::vector<double> emitted;  ///< flux into the scene, per band

    [[nodiscard]] bool is_dark() const {
        return std::all_of(emitted.begin(), emitted.end(), [](double x) { return x == 0; });
    }
};

/// Reads what those lights bring that have one copy of all bands for themselves.
/// @param sums  of with_repeated_bands()
[[nodiscard]] LightResponse read_response(
    const Sums& sums, std::size_t copy, const BasisLayout& layout);

/// What comes straight from suns.
/// @param replicates  what each sees
[[nodiscard]] LightResponse response_of_suns(
    const std::vector<SunLight>& replicates, const BasisLayout& layout);

}  // namespace quasimc

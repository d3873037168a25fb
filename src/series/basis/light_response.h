#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "quasimc/sums.h"
#include "series/basis/bin_index.h"
#include "solvers/direct/sun_pixels.h"

namespace quasimc {

/// The light of a scene due to one source, linear in its amount except for noise.
struct LightResponse {
    /// [replicate][BinIndex]: flux, or sunlit area
    std::vector<std::vector<float>> bins;
    std::vector<double> emitted;  ///< flux into the scene, per band

    [[nodiscard]] bool is_dark() const {
        return std::all_of(emitted.begin(), emitted.end(), [](double x) { return x == 0; });
    }
};

/// Reads the responses to lights that each have a copy of all bands.
/// @param sums  of with_repeated_bands()
[[nodiscard]] LightResponse read_response(
    const Sums& sums, std::size_t copy, const BasisLayout& layout);

/// The response to direct light of suns.
/// @param replicates  their light, per replicate
[[nodiscard]] LightResponse response_of_suns(
    const std::vector<SunLight>& replicates, const BasisLayout& layout);

}  // namespace quasimc

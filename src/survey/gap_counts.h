#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quasimc/gap_fraction.h"

namespace quasimc {

/// The rays that left the scene.
struct GapCounts {
    std::size_t positions = 0, rings = 0, sectors = 0, replicates = 0;
    std::uint32_t rays = 0;           ///< number in each bin of each replicate
    std::vector<std::uint32_t> open;  ///< see at()

    [[nodiscard]] std::size_t bins() const { return rings * sectors; }
    [[nodiscard]] std::uint32_t& at(std::size_t replicate, std::size_t position, std::size_t bin) {
        return open[(replicate * positions + position) * bins() + bin];
    }
    [[nodiscard]] std::uint32_t at(
        std::size_t replicate, std::size_t position, std::size_t bin) const {
        return open[(replicate * positions + position) * bins() + bin];
    }
};

/// The gap fraction of each sector, in the order of GapFractions::gap().
[[nodiscard]] std::vector<Estimate> gaps_of(const GapCounts& counts);

/// Indices from the gaps of `count` positions from `first` on.
[[nodiscard]] GapIndices gap_indices(
    const GapFractionSpec& spec, const GapCounts& counts, std::size_t first, std::size_t count);

}  // namespace quasimc

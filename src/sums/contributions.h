#pragma once

// Error estimates for few contributions: docs/theory/statistics.md.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace quasimc {

/// The largest contribution of a single sample to a quantity of a region: after n samples (Sums)
/// `largest[column] * scale[region] / n`. The upper limit of a quantity with zero contributions
/// follows from it.
struct ContributionBound {
    std::string quantity;  ///< "direct", "scattered", "sunlit", "light_path", ...
    std::vector<double> largest;
    std::vector<double> scale = {};  ///< per region; empty: 1

    [[nodiscard]] double of(std::size_t region, std::size_t column = 0) const {
        return largest.empty() ? 0 : largest[column] * (scale.empty() ? 1 : scale[region]);
    }
    friend bool operator==(const ContributionBound&, const ContributionBound&) = default;
};

/// The sample that makes one contribution to direct light: a path, a scan line, or a direction of
/// the skies.
enum class SampledBy { paths, lines, directions };

/// One technique that samples the direct light of some lights. The error of few contributions is
/// estimated strategy by strategy, as their contributions differ in size, and a region may have
/// light of the sun but none of the sky.
struct SamplingStrategy {
    SampledBy by = SampledBy::paths;
    bool has_suns = false;
    /// The strategy samples these lights and no others. Empty: their light is summed with that of
    /// another strategy, so the contributions of this one are unknown.
    std::vector<std::size_t> spectra;
    std::vector<double> flux;  ///< per band, as SumUnits::flux, of the brightest spectrum
    /// By side of a region (2 * region + side): largest fraction of a contribution's light that it
    /// receives, 0 if it faces none of the lights. For lines a length, in local units. Empty: 1.
    std::vector<double> reach = {};
    std::vector<double> sunlit_reach = {};  ///< for suns, by region: the same for sunlit area
    double step = 1;  ///< light of a contribution in the first round, in units
    double many = 5;  ///< contributions per replicate from which on replicates suffice
    /// Upper bound of `reach` for light that no replicate has sampled: the length of a segment on a
    /// lit part between the lines.
    double unseen_reach = std::numeric_limits<double>::infinity();

    friend bool operator==(const SamplingStrategy&, const SamplingStrategy&) = default;
};

}  // namespace quasimc

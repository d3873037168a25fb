#pragma once

// How much few contributions may hide: docs/theory/statistics.md.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace quasimc {

/// A bound is the largest contribution that a single sample makes to a quantity of a region: after
/// n samples (Sums) `largest[column] * scale[region] / n`. The upper limit of a quantity to which
/// nothing was contributed is made of it.
struct ContributionBound {
    std::string quantity;  ///< "direct", "scattered", "sunlit", "light_path", ...
    std::vector<double> largest;
    std::vector<double> scale = {};  ///< per region; empty: 1

    [[nodiscard]] double of(std::size_t region, std::size_t column = 0) const {
        return largest.empty() ? 0 : largest[column] * (scale.empty() ? 1 : scale[region]);
    }
    friend bool operator==(const ContributionBound&, const ContributionBound&) = default;
};

/// What a contribution to direct light is: a path, all that comes along a scan line, or a
/// direction of the skies.
enum class SampledBy { paths, lines, directions };

/// A sampling strategy finds the direct light of some lights in one way. What a run may have
/// overlooked is estimated strategy by strategy: their contributions are of different sizes, and
/// what the sun lights the sky may not have reached.
struct SamplingStrategy {
    SampledBy by = SampledBy::paths;
    bool has_suns = false;
    /// Of these lights, and of no others; empty: of another strategy's lights too, so that it is
    /// not known what this one has contributed of their light.
    std::vector<std::size_t> spectra;
    std::vector<double> flux;  ///< per band, as SumUnits::flux: of the brightest spectrum
    /// By side of a region (2 * region + side): how much of the light of one contribution it can
    /// get, 0 where it faces none of the lights. Of lines: a length, in local units. Empty: all.
    std::vector<double> reach = {};
    std::vector<double> sunlit_reach = {};  ///< of suns, by region: the same of the area lit
    double step = 1;  ///< light of a contribution in the first round, in units
    double many = 5;  ///< contributions in each replicate from which on replicates tell all
    /// How much of `reach` one contribution could be of light that no replicate has met at all: of
    /// a lit part that slips through between lines none could cut more than that.
    double unseen_reach = std::numeric_limits<double>::infinity();

    friend bool operator==(const SamplingStrategy&, const SamplingStrategy&) = default;
};

}  // namespace quasimc

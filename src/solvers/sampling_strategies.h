#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "sums/fixed_point.h"
#include "sums/light_blocks.h"
#include "sums/sum_data.h"
#include "sums/tally.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Strategies for lights that are sampled by paths, each path one contribution: for suns, skies and
/// lamps, if there are any.
[[nodiscard]] std::vector<SamplingStrategy> strategies_by_path(const PreparedScene& prepared);

/// The strategy for skies, whose light is sampled along directions.
/// @param step  light along each direction, in units
[[nodiscard]] SamplingStrategy strategy_by_direction(const PreparedScene& prepared, double step);

/// The strategy for suns, whose light is sampled along lines.
/// @param has_lines  by light: whether it is sampled along lines
/// @param step  light per unit length of a line, in units
/// @param spacing  largest distance of neighbouring lines, local units
[[nodiscard]] SamplingStrategy strategy_by_line(
    const PreparedScene& prepared, const std::vector<bool>& has_lines, double step, double spacing);

/// The strategy for suns of which each replicate picks some, whose lines are one contribution.
/// @param has_lines  by light: whether it is sampled along lines
/// @param step  light of a picked sun, in units
[[nodiscard]] SamplingStrategy strategy_by_pick(
    const PreparedScene& prepared, const std::vector<bool>& has_lines, double step);

/// The strategy for suns that are sampled by paths if others are sampled along lines. The
/// contributions of both are summed together and cannot be separated.
/// @param has_lines  by light: whether it is sampled along lines
[[nodiscard]] SamplingStrategy strategy_of_traced_suns(
    const PreparedScene& prepared, const std::vector<bool>& has_lines);

/// The strategies of sums, and the blocks for squares of the contributions of the first of them,
/// relative to the largest possible ones (SamplingStrategy::step).
struct CountedStrategies {
    explicit CountedStrategies(const SumData& sums)
        : strategies(sums.strategies), squares(sums.layout, "squares") {}
    /// Declares the blocks of squares for the given number of strategies.
    static void declare(std::size_t strategies, SumBlocks& blocks) {
        declare_sides("squares", columns_of(SumColumn::Of::strategy, strategies), blocks);
    }

    std::span<const SamplingStrategy> strategies;
    SideBlocks squares;
};

/// Counts the contributions of one sample (a direction, or some lines) to each side of each region.
class ContributionCounter {
  public:
    /// Counts what `add_all(counter)` adds.
    /// @param strategy  its index
    /// @param lines  number of lines in the sample; 1 for a direction
    template <typename AddAll>
    static void count(
        const PreparedScene& prepared,
        const CountedStrategies& counted,
        std::size_t strategy,
        double lines,
        Tally& tally,
        const AddAll& add_all) {
        ContributionCounter counter(prepared, counted, strategy, lines, tally);
        add_all(counter);
        counter.finish_region();
    }

    /// Adds light on a triangle. Triangles of a region follow each other.
    /// @param along  dot(unit normal of the upper side, direction of the light)
    /// @param amount  units of light
    /// @param segments  their number, along lines
    void add(std::uint32_t triangle, double along, double amount, std::uint32_t segments = 1) {
        const std::uint32_t region = prepared_.region(triangle);
        if (region != region_) {
            finish_region();
            region_ = region;
        }
        if (!prepared_.fields_of_view().contain(region, std::abs(along))) {
            return;
        }
        // One side receives nothing; no branch predictor could guess which.
        const auto is_lower = static_cast<std::uint32_t>(along > 0);
        upper_.add(amount * (1 - is_lower), segments * (1 - is_lower));
        lower_.add(amount * is_lower, segments * is_lower);
    }

  private:
    struct Contribution {
        double amount = 0, segments = 0;

        void add(double more, std::uint32_t more_segments) {
            amount += more;
            segments += more_segments;
        }
    };

    ContributionCounter(
        const PreparedScene& prepared,
        const CountedStrategies& counted,
        std::size_t strategy,
        double lines,
        Tally& tally)
        : prepared_(prepared),
          reach_(counted.strategies[strategy].reach),
          step_(counted.strategies[strategy].step),
          lines_(lines),
          squares_(counted.squares),
          strategy_(strategy),
          tally_(tally) {}

    void finish_region() {
        if (std::min(upper_.amount, lower_.amount) > 0) [[unlikely]] {
            add_squares(SurfaceSide::upper, upper_);
            add_squares(SurfaceSide::lower, lower_);
        } else {
            const double segments = upper_.segments + lower_.segments;
            add_squares(
                lower_.amount > 0 ? SurfaceSide::lower : SurfaceSide::upper,
                {upper_.amount + lower_.amount, segments});
        }
        upper_ = lower_ = {};
    }

    void add_squares(SurfaceSide side, const Contribution& found) {
        const double most = reach_[std::size_t{2} * region_ + index_of(side)] * step_;
        if (found.amount > 0 && most > 0) {
            const double square =
                found.amount * found.amount / (most * most * std::min(found.segments, lines_));
            tally_.add(squares_.bin(region_, side, strategy_), to_fixed(square));
        }
    }

    const PreparedScene& prepared_;
    std::span<const double> reach_;
    double step_, lines_;
    SideBlocks squares_;
    std::size_t strategy_;
    Tally& tally_;
    std::uint32_t region_ = 0;
    Contribution upper_, lower_;  // of the region
};

}  // namespace quasimc

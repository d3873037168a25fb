#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "quasimc/sums.h"
#include "sums/fixed_point.h"
#include "sums/tally.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Lights of which each path is a find of its own: one kind of suns, one of skies, one of lamps;
/// those there are.
[[nodiscard]] std::vector<LightKind> kinds_by_path(const PreparedScene& prepared);

/// The skies, whose light is found along directions.
/// @param directions  in each replicate, of the first round
/// @param step  units of light of each
[[nodiscard]] LightKind kind_by_direction(
    const PreparedScene& prepared, std::uint32_t directions, double step);

/// The suns, whose light is found along lines.
/// @param has_lines  by light: those of which it is
/// @param step  units of light that a unit of length of a line brings
/// @param spacing  of the lines, local units, at most
[[nodiscard]] LightKind kind_by_line(
    const PreparedScene& prepared, const std::vector<bool>& has_lines, double step, double spacing);

/// The suns that are traced from themselves beside others whose light is found along lines. What
/// they bring is summed with that of the others: of none of it is it known that it was found.
/// @param has_lines  by light: those of which it is not
[[nodiscard]] LightKind kind_of_traced_suns(
    const PreparedScene& prepared, const std::vector<bool>& has_lines);

/// Counts the contributions of one sample (a direction, or some lines) to each side of each region.
class ContributionCounter {
  public:
    /// Counts what `add_all(counter)` adds.
    /// @param kind  place in SumUnits::kinds
    /// @param lines  that the sample consists of; 1 for a direction
    template <typename AddAll>
    static void count(
        const PreparedScene& prepared,
        const SumUnits& units,
        std::size_t kind,
        double lines,
        Tally& tally,
        const AddAll& add_all) {
        ContributionCounter counter(prepared, units, kind, lines, tally);
        add_all(counter);
        counter.finish_region();
    }

    /// Adds light on a triangle. Triangles of a region follow each other.
    /// @param along  dot(unit normal of the upper side, direction of the light)
    /// @param amount  units of light
    /// @param segments  along lines
    void add(std::uint32_t triangle, double along, double amount, std::uint32_t segments = 1) {
        const std::uint32_t region = prepared_.region(triangle);
        if (region != region_) {
            finish_region();
            region_ = region;
        }
        if (!prepared_.fields_of_view().contain(region, std::abs(along))) {
            return;
        }
        // Nothing comes to one side, and no branch could guess to which.
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
        const SumUnits& units,
        std::size_t kind,
        double lines,
        Tally& tally)
        : prepared_(prepared),
          reach_(units.kinds[kind].reach),
          step_(units.kinds[kind].step),
          lines_(lines),
          first_bin_(tally.layout().squares(0, SurfaceSide::upper, kind)),
          stride_(tally.layout().stride()),
          tally_(tally) {}

    void finish_region() {
        if (std::min(upper_.amount, lower_.amount) > 0) [[unlikely]] {
            add_squares(0, upper_);
            add_squares(1, lower_);
        } else {
            const double segments = upper_.segments + lower_.segments;
            add_squares(lower_.amount > 0 ? 1 : 0, {upper_.amount + lower_.amount, segments});
        }
        upper_ = lower_ = {};
    }

    void add_squares(std::size_t side, const Contribution& found) {
        const double most = reach_[std::size_t{2} * region_ + side] * step_;
        if (found.amount > 0 && most > 0) {
            const double square =
                found.amount * found.amount / (most * most * std::min(found.segments, lines_));
            tally_.add(first_bin_ + region_ * stride_ + side, to_fixed(square));
        }
    }

    const PreparedScene& prepared_;
    std::span<const double> reach_;
    double step_, lines_;
    std::size_t first_bin_, stride_;
    Tally& tally_;
    std::uint32_t region_ = 0;
    Contribution upper_, lower_;  // of the region
};

}  // namespace quasimc

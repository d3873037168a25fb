#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "results/bounds/organ_reader.h"
#include "sums/statistics.h"

namespace quasimc {

/// Size of one contribution to the light of an organ in a band: how much one more or one less would
/// change an estimate (docs/theory/statistics.md).
class OrganContributions {
  public:
    OrganContributions(const OrganReader& reader, std::size_t band);

    /// Estimates a quantity.
    /// @param per_area  1 / area of the organ
    /// @param values  the quantity, per replicate
    [[nodiscard]] Estimate estimate(
        const QuantityEntry& entry, double per_area, std::span<const double> values) const;

    /// Whether the size of contributions is known: by the unoccluded light, or for each sampling
    /// strategy.
    [[nodiscard]] bool knows_contributions() const { return knows_unoccluded_ || knows_kinds_; }
    /// Whether each strategy has enough contributions for one more to change nothing.
    [[nodiscard]] bool has_enough_contributions() const { return is_settled_; }
    /// One contribution to a quantity, as flux. Requires knows_contributions().
    [[nodiscard]] ContributionSize contribution(Quantity quantity) const;

    /// One contribution to all light that falls on both sides, as flux; zero where it is unknown.
    [[nodiscard]] ContributionSize incident_contribution() const;

    /// The parts of a contribution: light that one line or direction may deliver to many organs at
    /// once, and light that a path delivers to a single one.
    struct Parts {
        ContributionSize by_sky_sample, by_path;
    };
    [[nodiscard]] Parts parts(Quantity quantity) const { return parts(parts_of(quantity)); }
    [[nodiscard]] Parts parts(const LightParts& parts) const;

    /// One contribution to the sunlit area of an organ; requires strategies.
    [[nodiscard]] static ContributionSize sunlit_contribution(const OrganReader& reader);

  private:
    void set_unoccluded(const OrganReader& reader, std::size_t band);
    void set_kinds(const OrganReader& reader, std::size_t band);
    void set_scattered(const OrganReader& reader, std::size_t band);

    /// Direct light, light of paths, or scattered light.
    struct Kind {
        ContributionSize upper, lower;
    };
    template <typename Together>
    static ContributionSize on_sides(const Kind& kind, const LightParts& parts, Together together);

    bool knows_unoccluded_, knows_kinds_;
    bool is_settled_ = false;
    double absorptance_;
    double bound_;  ///< one contribution in one replicate, where unoccluded light is unknown
    Kind direct_, scattered_;
    Kind by_path_;                ///< direct light sampled by paths, where strategies are known
    ContributionSize on_either_;  ///< scattered light on either side
};

/// Estimates the sunlit part of an area from points on it.
/// @param values  per replicate
/// @param all  the whole area: the upper limit where all points were lit, within rounding
/// @param contribution  area that one point represents
[[nodiscard]] Estimate estimate_sunlit_points(
    std::span<const double> values, double all, double contribution);

/// Light that falls on both sides in a band.
struct IncidentLight {
    std::vector<double> per_replicate;
    ContributionSize contribution;  ///< in the same unit
};

/// The ratio of the light in two bands. One contribution may hold light of a single band.
[[nodiscard]] Estimate estimate_light_ratio(const IncidentLight& above, const IncidentLight& below);

}  // namespace quasimc

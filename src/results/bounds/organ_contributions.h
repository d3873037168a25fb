#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "results/bounds/organ_reader.h"
#include "sums/statistics.h"

namespace quasimc {

/// By how much one find more, or one less, would change what is known of an organ in a band: see
/// docs/theory/statistics.md.
class OrganContributions {
  public:
    OrganContributions(const OrganReader& reader, std::size_t band);

    /// The estimate of a quantity.
    /// @param per_area  1 / area of the organ
    /// @param values  of the quantity, per replicate
    [[nodiscard]] Estimate estimate(
        const QuantityEntry& entry, double per_area, std::span<const double> values) const;

    /// Whether it is known what could have been found: all light that nothing stands in the way of,
    /// or what a find of each kind of light may bring.
    [[nodiscard]] bool knows_contributions() const { return knows_unoccluded_ || knows_kinds_; }
    /// Whether there are so many of each kind that one more changes nothing.
    [[nodiscard]] bool has_enough_contributions() const { return is_settled_; }
    /// A find of a quantity, as flux. To be asked where knows_contributions().
    [[nodiscard]] ContributionSize find(Quantity quantity) const;

    /// Of all light that falls on both sides, as flux; none where it is not known.
    [[nodiscard]] ContributionSize incident_contribution() const;

    /// The same in two parts: of light that many organs may find at once, along a line or a
    /// direction, and of what a path brings to a single one.
    struct Parts {
        ContributionSize by_sky_sample, by_path;
    };
    [[nodiscard]] Parts parts(Quantity quantity) const { return parts(parts_of(quantity)); }
    [[nodiscard]] Parts parts(const LightParts& parts) const;

    /// A find of the sunlit area of an organ, where kinds of light are known.
    [[nodiscard]] static ContributionSize sunlit_contribution(const OrganReader& reader);

  private:
    void set_unoccluded(const OrganReader& reader, std::size_t band);
    void set_kinds(const OrganReader& reader, std::size_t band);
    void set_scattered(const OrganReader& reader, std::size_t band);

    /// One kind of light.
    struct Kind {
        ContributionSize upper, lower;
    };
    template <typename Together>
    static ContributionSize on_sides(const Kind& kind, const LightParts& parts, Together together);

    bool knows_unoccluded_, knows_kinds_;
    bool is_settled_ = false;
    double absorptance_;
    double bound_;  ///< where unoccluded light is not known: a find, in one replicate
    Kind direct_, scattered_;
    Kind by_path_;  ///< direct light of which each path is a find, where kinds are known
    ContributionSize on_either_;  ///< scattered light, whichever side
};

/// The estimate of what of an area is sunlit, from points on it.
/// @param values  per replicate
/// @param all  the whole area: where all points were lit it is no more, and no less to rounding
/// @param find  what one point stands for
[[nodiscard]] Estimate estimate_sunlit_points(
    std::span<const double> values, double all, double find);

/// What falls on both sides in a band.
struct IncidentLight {
    std::vector<double> per_replicate;
    ContributionSize find;  ///< in the same unit
};

/// The ratio of what falls in two bands: a find more or less may bring light of one of them alone.
[[nodiscard]] Estimate estimate_light_ratio(const IncidentLight& above, const IncidentLight& below);

}  // namespace quasimc

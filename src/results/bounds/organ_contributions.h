#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "results/bounds/organ_reader.h"
#include "sums/statistics.h"

namespace quasimc {

/// The change of the light of an organ, or of a group, by one contribution more or less, in a
/// band (docs/theory/statistics.md).
class OrganContributions {
  public:
    /// No contribution: of a group without organs.
    OrganContributions() = default;
    OrganContributions(const OrganReader& reader, std::size_t band);
    /// Contributions to the sunlit area, of a side or of both.
    [[nodiscard]] static OrganContributions sunlit(
        const OrganReader& reader, std::optional<SurfaceSide> side = std::nullopt);

    /// Includes another organ of a group. @param weight  of its light, above 0
    void include(const OrganContributions& organ, double weight = 1);

    /// One contribution to the given parts of light, as flux (or sunlit area).
    [[nodiscard]] ContributionSize size(const LightParts& parts = kIncidentLight) const;
    /// One contribution to a quantity, as flux, as estimate() includes it.
    /// @param values  the quantity, per replicate
    [[nodiscard]] ContributionSize size(Quantity quantity, std::span<const double> values) const;

    /// Estimates the given parts of light. @param unit  of the values, per flux
    [[nodiscard]] Estimate estimate(
        const LightParts& parts, double unit, std::span<const double> values) const;
    /// Estimates a quantity.
    /// @param per_area  1 / area
    /// @param values  the quantity, per replicate
    [[nodiscard]] Estimate estimate(
        const QuantityEntry& entry, double per_area, std::span<const double> values) const;
    /// Estimates the sunlit fraction; of sunlit().
    /// @param values  per replicate
    [[nodiscard]] Estimate estimate_sunlit(double area, std::span<const double> values) const;

    /// The ratio of the light in two bands.
    /// @param a, b  all light on both sides, per replicate, flux
    [[nodiscard]] static Estimate estimate_ratio(
        const OrganContributions& above,
        const OrganContributions& below,
        std::span<const double> a,
        std::span<const double> b);

  private:
    /// The sample of a contribution: a path, which contributes once; a point of an organ; a
    /// direction or a line, which may contribute to several organs.
    enum class Sample { path, point, ray };
    /// The light of one strategy on one side.
    struct Kind {
        SurfaceSide side = SurfaceSide::upper;
        bool is_direct = true;
        bool has_suns = false;          ///< direct light of suns alone
        bool has_one_spectrum = false;  ///< a contribution has the same colour as all others
        Sample sample = Sample::path;
        ContributionSize size = {};
        double unseen = 0;  ///< in addition: to organs without contributions, from one ray
    };
    /// Combines the kinds: a path more is of one kind, other samples may be missing of each.
    /// @param size_of  of a kind and its index
    template <typename SizeOf>
    [[nodiscard]] ContributionSize combined(const SizeOf& size_of) const;
    void read_strategies(const OrganReader& reader, std::size_t band);
    void read_points(const OrganReader& reader, std::size_t band);

    std::vector<Kind> kinds_;  ///< in the same order for all organs and bands
    double absorptance_ = 0;
    double bound_ = 0;  ///< largest contribution, where only this is known; for dark organs
    bool has_points_ = false;
};

}  // namespace quasimc

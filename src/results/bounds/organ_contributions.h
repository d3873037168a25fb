#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "results/bounds/organ_reader.h"
#include "sums/statistics.h"

namespace quasimc {

/// The sample of a contribution: a path, which contributes once; a point of an organ; a direction
/// or a line, which may contribute to several organs.
enum class Sample : std::uint8_t { path, point, ray };

/// A kind of contributions.
struct ContributionKind {
    Sample sample = Sample::path;
    /// With this many in all replicates, their scatter shows the error; 0: they are not counted.
    double many = 0;

    [[nodiscard]] bool is_counted() const { return many > 0; }
    friend bool operator==(const ContributionKind&, const ContributionKind&) = default;
};

/// How a number of a weighted sum follows from those of its terms.
enum class SumRule : std::uint8_t {
    sum,              ///< terms are weight x number
    root_of_squares,  ///< adds squares of weight x number
    largest,          ///< takes the largest weight x number
    largest_of_all,   ///< takes the largest number, whatever its weight
};

/// The contributions of a kind to the light of an organ, or of several: as changes of the mean of
/// the replicates. Light may be counted, or its contributions alone be known.
struct Contributions {
    double light = 0;    ///< their sum
    double root = 0;     ///< root of the sum of their squares
    double largest = 0;  ///< one to organs that have some
    double unseen = 0;   ///< one to organs that have none
    double varies = 0;   ///< 1: replicates differ, and show how often they do
    // Not counted:
    double more = 0, less = 0;  ///< one more, one less

    /// Includes those to another organ. @param weight  of its light, above 0
    void include(const Contributions& other, const ContributionKind& kind, double weight);
};

/// A number of Contributions, and how it is summed.
struct ContributionNumber {
    double Contributions::*number;
    bool is_counted;  ///< kinds that are counted have it, or the others
    SumRule of_paths, of_rays;

    [[nodiscard]] SumRule rule(const ContributionKind& kind) const {
        return kind.sample == Sample::ray ? of_rays : of_paths;
    }
};

/// THE TABLE of numbers of contributions.
inline constexpr std::array<ContributionNumber, 7> kContributionNumbers{{
    {&Contributions::light, true, SumRule::sum, SumRule::sum},
    {&Contributions::root, true, SumRule::root_of_squares, SumRule::root_of_squares},
    {&Contributions::largest, true, SumRule::largest, SumRule::root_of_squares},
    {&Contributions::unseen, true, SumRule::largest, SumRule::sum},
    {&Contributions::varies, true, SumRule::largest_of_all, SumRule::largest_of_all},
    {&Contributions::more, false, SumRule::largest, SumRule::root_of_squares},
    {&Contributions::less, false, SumRule::largest, SumRule::root_of_squares},
}};

/// Calls visit(row of the table) for the numbers of a kind.
template <typename Visit>
void for_each_number(const ContributionKind& kind, const Visit& visit) {
    for (const ContributionNumber& row : kContributionNumbers) {
        if (row.is_counted == kind.is_counted()) {
            visit(row);
        }
    }
}

/// The contributions of one kind.
struct SampledContributions {
    ContributionKind kind;
    Contributions all;

    /// The change by one contribution more or less.
    [[nodiscard]] ContributionSize one() const;
};

/// The change by one contribution of any kind: a path more is of one kind, other samples may be
/// missing of each.
[[nodiscard]] ContributionSize one_contribution(std::span<const SampledContributions> kinds);

/// Estimates the sunlit fraction from contributions to it.
/// @param lit  the fraction, per replicate
/// @param has_points  whether contributions are points of the organs
[[nodiscard]] Estimate estimate_sunlit_fraction(
    std::span<const double> lit, ContributionSize one, bool has_points);

/// The change of the light of an organ, or of a group, by one contribution more or less, in a
/// band (docs/theory/statistics.md).
class OrganContributions {
  public:
    /// No contribution: of a group without organs.
    OrganContributions() = default;
    OrganContributions(const OrganReader& reader, std::size_t band)
        : OrganContributions(reader, band, reader.incident(band)) {}
    /// @param light  of the organ, all replicates together
    OrganContributions(const OrganReader& reader, std::size_t band, const Incident& light);
    /// Contributions to the sunlit area, of a side or of both.
    [[nodiscard]] static OrganContributions sunlit(
        const OrganReader& reader, std::optional<SurfaceSide> side = std::nullopt);

    /// Includes another organ of a group. @param weight  of its light, above 0
    void include(const OrganContributions& organ, double weight = 1);

    /// One contribution to the given parts of light, as flux (or sunlit area).
    [[nodiscard]] ContributionSize size(const LightParts& parts = kIncidentLight) const;
    /// The same, as estimate() includes it.
    /// @param values  these parts of light, per replicate
    [[nodiscard]] ContributionSize size(
        const LightParts& parts, std::span<const double> values) const;
    /// One contribution to a quantity, as flux, as estimate() includes it.
    /// @param values  the quantity, per replicate
    [[nodiscard]] ContributionSize size(Quantity quantity, std::span<const double> values) const;
    /// The kinds of contributions to the given parts of light, as many for all organs.
    [[nodiscard]] std::vector<SampledContributions> kinds(const LightParts& parts) const;
    /// The largest fraction of light that a side absorbs.
    [[nodiscard]] double absorptance() const { return absorptance_; }
    /// The largest contribution, where only this is known, as flux; else 0.
    [[nodiscard]] double bound() const { return bound_; }

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
    /// The light of one strategy on one side.
    struct Kind {
        SurfaceSide side = SurfaceSide::upper;
        bool is_direct = true;
        bool has_suns = false;          ///< direct light of suns alone
        bool has_one_spectrum = false;  ///< a contribution has the same colour as all others
        SampledContributions sampled = {};
    };
    /// Combines the kinds: see one_contribution().
    /// @param size_of  of a kind and its index
    template <typename SizeOf>
    [[nodiscard]] ContributionSize combined(const SizeOf& size_of) const;
    static bool includes(const LightParts& parts, const Kind& kind);
    void read_strategies(const OrganReader& reader, std::size_t band, const Incident& light);
    void read_points(const OrganReader& reader, std::size_t band, const Incident& light);

    std::vector<Kind> kinds_;  ///< in the same order for all organs and bands
    double absorptance_ = 0;
    double bound_ = 0;  ///< largest contribution, where only this is known; for dark organs
    bool has_points_ = false;
};

}  // namespace quasimc

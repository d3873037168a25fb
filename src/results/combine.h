#pragma once

// Weighted sums of the light of organs, with the errors of the sums.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "results/bounds/organ_contributions.h"
#include "results/bounds/organ_reader.h"
#include "scene/scene.h"

namespace quasimc {

/// Organs whose light is added, each times a positive weight.
struct OrganWeights {
    std::span<const std::uint32_t> organs;  ///< indices in the scene's list
    std::span<const double> weights = {};   ///< one for each; empty: all 1

    [[nodiscard]] double weight(std::size_t i) const { return weights.empty() ? 1 : weights[i]; }
    /// At most `count` organs from `first` on.
    [[nodiscard]] OrganWeights part(std::size_t first, std::size_t count) const {
        const std::size_t size = std::min(count, organs.size() - first);
        return {
            organs.subspan(first, size), weights.empty() ? weights : weights.subspan(first, size)};
    }
};

/// The light of several organs together, per replicate: errors of organs that shade one another are
/// correlated, and only the scatter of their sum shows its error.
struct CombinedLight {
    std::vector<Incident> light;  ///< [band * replicates + replicate], flux
    std::vector<double> sunlit;   ///< [replicate], area; 0 without directional sources

    /// Adds the light of other organs.
    void add(const CombinedLight& other);
};

/// Adds up the light of organs. All arguments of the constructor must outlive it.
class LightCombiner {
  public:
    LightCombiner(const Sums& sums, const Scene& scene, const EvaluationSpec& spec)
        : sums_(sums), reader_(sums), scene_(scene), spec_(spec) {}

    [[nodiscard]] std::size_t bands() const { return sums_->bands(); }
    [[nodiscard]] std::size_t replicates() const { return sums_->replicates.size(); }
    [[nodiscard]] bool has_sun() const { return sums_->units.sunlit_area > 0; }

    /// Light of no organ.
    [[nodiscard]] CombinedLight empty() const;
    /// Adds organs in their order, in one replicate.
    void add_up(const OrganWeights& of, std::uint32_t replicate, CombinedLight& sum) const;
    /// @returns by band. Organ by organ, as their sums are stored
    [[nodiscard]] std::vector<OrganContributions> contributions(const OrganWeights& of) const;
    /// Contributions to the sunlit area.
    [[nodiscard]] OrganContributions sunlit_contributions(const OrganWeights& of) const;

    /// The value of every quantity in a band, per replicate.
    [[nodiscard]] QuantitySamples samples(
        const CombinedLight& sum, std::size_t band, double per_area) const;

  private:
    [[nodiscard]] OrganReader reader_of(std::uint32_t organ) const {
        return {reader_, scene_, spec_, scene_.organs()[organ]};
    }

    const Sums& sums_;
    SumReader reader_;
    const Scene& scene_;
    const EvaluationSpec& spec_;
};

/// The weighted sums of quantities, replicate by replicate. Unknown if an organ is not measured.
struct CombinedReplicates {
    /// [((replicate * sums + sum) * quantities + quantity) * bands + band], flux
    std::vector<double> values;
    /// [(sum * quantities + quantity) * bands + band]: one contribution, flux
    std::vector<ContributionSize> sizes;
};
[[nodiscard]] CombinedReplicates combine_replicates(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    std::span<const OrganWeights> of,
    std::span<const Quantity> quantities);

}  // namespace quasimc

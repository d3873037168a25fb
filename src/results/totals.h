#pragma once

#include <mutex>
#include <span>
#include <string_view>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"
#include "sums/statistics.h"

namespace quasimc {

/// The largest contribution of an organ to the totals of organs and ground: with many contributions
/// the spread of the replicates covers the others.
struct TotalContribution {
    ContributionSize organs, ground;

    void include(const TotalContribution& other);
};

/// The largest contributions of each band, gathered on many threads.
class TotalContributions {
  public:
    explicit TotalContributions(std::size_t bands) : bands_(bands) {}

    /// Includes the contributions of some organs.
    void include(std::span<const TotalContribution> some);
    [[nodiscard]] const TotalContribution& of(std::size_t band) const { return bands_[band]; }

  private:
    std::mutex mutex_;
    std::vector<TotalContribution> bands_;
};

/// Completes the errors of the totals of organs and ground, in the budget and as fractions of the
/// canopy, by what replicates do not show: upper bounds where no light was sampled, the size of one
/// contribution, and the emitted flux as a limit.
void report_errors_of_totals(
    const Sums& sums, const Scene& scene, const TotalContributions& contributions, Result& result);

/// The light of the whole scene, replicate by replicate, for arithmetic beyond the budget and the
/// fractions of the canopy.
struct TotalReplicates {
    std::string_view name;                ///< as in the budget; or incident, reflected, transmitted
    std::vector<double> values;           ///< [replicate * bands + band], flux
    std::vector<ContributionSize> sizes;  ///< by band: one contribution, as in the budget's errors
};
/// @returns the parts of the budget; and light on the horizontal, light that the canopy reflects,
/// and light on the ground, where these are known
[[nodiscard]] std::vector<TotalReplicates> replicates_of_totals(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec);

}  // namespace quasimc

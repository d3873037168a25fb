#pragma once

#include <mutex>
#include <span>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"
#include "sums/statistics.h"

namespace quasimc {

/// What one find more or less changes in what organs absorb together, and the ground: the largest
/// find of an organ, for with many finds the replicates tell what the others leave open.
struct TotalContribution {
    ContributionSize organs, ground;

    void include(const TotalContribution& other);
};

/// The total finds of each band, gathered on many threads.
class TotalContributions {
  public:
    explicit TotalContributions(std::size_t bands) : bands_(bands) {}

    /// Includes the finds of some organs.
    void include(std::span<const TotalContribution> some);
    [[nodiscard]] const TotalContribution& of(std::size_t band) const { return bands_[band]; }

  private:
    std::mutex mutex_;
    std::vector<TotalContribution> bands_;
};

/// Tells of what organs and the ground absorb in all, in the budget and as fractions of the canopy,
/// what the replicates do not show: how much may be there where nothing was found, what a find more
/// or less changes, and that it is not more than what is emitted.
void report_errors_of_totals(
    const Sums& sums, const Scene& scene, const TotalContributions& finds, Result& result);

}  // namespace quasimc

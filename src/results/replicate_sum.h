#pragma once

// Weighted sums over several runs, with the errors of the sums.

#include <cstddef>
#include <vector>

#include "results/combine.h"
#include "sums/statistics.h"

namespace quasimc {

/// Weighted sums of amounts over the points of a sweep, replicate by replicate. Points share their
/// random numbers, so that their errors are correlated: a replicate is added to the one of the same
/// number, and only the scatter of these sums shows the error.
class ReplicateSum {
  public:
    ReplicateSum() = default;
    /// @param amounts  number of sums
    ReplicateSum(std::size_t replicates, std::size_t amounts)
        : amounts_(amounts), values_(replicates * amounts), sizes_(amounts), of_point_(amounts) {}

    /// Adds `weight` >= 0 times the amounts of a computation. Those of one point have different
    /// random numbers.
    /// @param light  with as many replicates and amounts
    void add(const CombinedReplicates& light, double weight);
    /// Ends a point. A contribution that the random numbers of a point miss may be missing from all
    /// others as well.
    void end_point();

    [[nodiscard]] std::size_t replicates() const {
        return amounts_ == 0 ? 0 : values_.size() / amounts_;
    }
    /// A sum in each replicate.
    [[nodiscard]] std::vector<double> values(std::size_t amount) const;
    /// The change of a sum by one contribution.
    [[nodiscard]] ContributionSize size(std::size_t amount) const { return sizes_[amount]; }
    /// The estimate of a sum times `factor` > 0.
    [[nodiscard]] Estimate estimate(std::size_t amount, double factor) const;

  private:
    std::size_t amounts_ = 0;
    std::vector<double> values_;              // [replicate * amounts + amount]
    std::vector<ContributionSize> sizes_;     // of points that ended
    std::vector<ContributionSize> of_point_;  // of the current point
};

}  // namespace quasimc

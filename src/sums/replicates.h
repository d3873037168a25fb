#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "sums/tally.h"

namespace quasimc {

/// The sums of every replicate, and where workers leave theirs.
class Replicates {
  public:
    /// @param workers  that will trace at the same time
    /// @param most_private_bytes  for all workers' own tallies; beyond it they share one per
    /// replicate
    /// @param private_elements  the last so many elements are always the workers' own: those that
    /// most light hits
    Replicates(
        const TallyLayout& layout,
        std::uint32_t count,
        unsigned workers,
        double most_private_bytes,
        std::size_t private_regions);

    [[nodiscard]] const TallyLayout& layout() const { return layout_; }
    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(cells_.size()); }
    [[nodiscard]] std::span<const std::int64_t> cells(std::uint32_t replicate) const {
        return cells_[replicate];
    }

    /// The worker's tally, set to add to `replicate`. What it holds of another replicate is left
    /// there first.
    [[nodiscard]] Tally& tally_for(unsigned worker, std::uint32_t replicate);
    /// Leaves what every worker still holds with its replicate. No worker may be tracing.
    void collect();

  private:
    struct Worker {
        Tally tally;
        std::uint32_t replicate = 0;
    };
    void leave(Worker& worker);

    TallyLayout layout_;
    std::size_t shared_elements_ = 0;
    std::vector<std::vector<std::int64_t>> cells_;
    std::vector<Worker> workers_;
    std::vector<std::mutex> mutexes_;
};

}  // namespace quasimc

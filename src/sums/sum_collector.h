#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "sums/sum_data.h"
#include "sums/tally.h"

namespace quasimc {

/// Where workers leave what they summed: hands each a tally for the replicate it works on.
class SumCollector {
  public:
    /// @param sums  to add to; must outlive the collector
    /// @param workers  that will trace at the same time
    /// @param most_private_bytes  for all workers' own tallies; beyond it they share one per
    ///        replicate, as they do where there are very many regions
    /// @param private_regions  the last so many regions are always the workers' own: those that
    ///        most light hits
    SumCollector(
        SumData& sums, unsigned workers, double most_private_bytes, std::size_t private_regions);

    /// The worker's tally, set to add to `replicate`. What it holds of another replicate, or more
    /// than it should, is left there first.
    [[nodiscard]] Tally& tally_for(unsigned worker, std::uint32_t replicate);
    /// Leaves what every worker still holds with its replicate. No worker may be tracing.
    void collect();

  private:
    struct Worker {
        Tally tally;
        std::uint32_t replicate = 0;
    };
    void leave(Worker& worker);

    SumData& sums_;
    std::size_t shared_regions_ = 0;
    std::vector<Worker> workers_;
    std::vector<std::mutex> mutexes_;
};

}  // namespace quasimc

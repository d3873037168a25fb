#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "sums/sum_data.h"
#include "sums/tally.h"

namespace quasimc {

/// Collects the sums of workers: gives each a tally for the replicate in progress.
class SumCollector {
  public:
    /// @param sums  to add to; must outlive the collector
    /// @param workers  number of concurrent workers
    /// @param most_private_bytes  for all workers' own tallies; beyond it they share one per
    /// replicate, as for very many regions
    /// @param private_regions  number of last regions that are always the workers' own: those that
    /// most light hits
    SumCollector(
        SumData& sums, unsigned workers, double most_private_bytes, std::size_t private_regions);

    /// The worker's tally, set to add to `replicate`. Amounts of another replicate, or of a full
    /// tally, are moved to the sums first.
    [[nodiscard]] Tally& tally_for(unsigned worker, std::uint32_t replicate);
    /// Moves the amounts of all workers to the sums. No worker may be tracing.
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

#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/executor.h"
#include "base/parallel.h"
#include "solvers/solver.h"
#include "sums/sum_collector.h"

namespace quasimc {

/// The number of blocks of at most `size` items that hold `total` items.
[[nodiscard]] constexpr std::uint64_t block_count(std::uint64_t total, std::uint64_t size) {
    return (total + size - 1) / size;
}

/// Consecutive items, [begin, end).
struct BlockRange {
    std::uint64_t begin = 0, end = 0;
};
/// The items of a block: `size` of them, or the remainder of `total` in the last one.
[[nodiscard]] constexpr BlockRange block_range(
    std::uint64_t total, std::uint64_t size, std::uint64_t block) {
    return {block * size, std::min(total, (block + 1) * size)};
}

/// Runs the rounds of a solver that cuts them into independent blocks.
///
/// A block is a pure function of its number except for the order of its additions, and sums are
/// exact. So results do not depend on threads or the order of blocks.
/// @tparam Scratch  memory of a worker between blocks, made from the number of bands. Workers share
/// no cache line.
template <typename Scratch>
class BlockRunner {
  public:
    explicit BlockRunner(const SolverInput& input)
        : bands_(input.prepared.bands()),
          most_private_bytes_(input.spec.tally_memory_mb * 1e6),
          private_regions_(ground_regions(input.prepared.scene())) {}

    /// Calls `trace(replicate, block, scratch, tally)` for every block of every replicate.
    /// @param tasks  the round of tasks that contains these
    template <typename Trace>
    void run(std::uint64_t blocks, TaskRound& tasks, Sums& sums, const Trace& trace) {
        while (scratch_.size() < tasks.workers()) {
            scratch_.push_back(std::make_unique<Aligned>(bands_));
        }
        SumCollector collector(*sums, tasks.workers(), most_private_bytes_, private_regions_);
        const auto run_task = [&](std::uint64_t task, unsigned worker) {
            const auto replicate = static_cast<std::uint32_t>(task / blocks);
            Tally& tally = collector.tally_for(worker, replicate);
            trace(replicate, task % blocks, scratch_[worker]->scratch, tally);
        };
        tasks.run(blocks * sums->replicates.size(), run_task, [&] { collector.collect(); });
        collector.collect();
    }

  private:
    /// The number of regions of the ground, which come last.
    static std::size_t ground_regions(const Scene& scene) {
        const std::vector<Region>& regions = scene.regions();
        return static_cast<std::size_t>(std::count_if(
            regions.begin(), regions.end(),
            [&](const Region& region) { return scene.organs()[region.organ.value].is_ground; }));
    }

    struct alignas(2 * kCacheLine) Aligned {
        explicit Aligned(std::size_t bands) : scratch(bands) {}
        Scratch scratch;
    };

    std::size_t bands_;
    double most_private_bytes_;
    std::size_t private_regions_;
    std::vector<std::unique_ptr<Aligned>> scratch_;
};

}  // namespace quasimc

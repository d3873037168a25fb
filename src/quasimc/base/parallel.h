#pragma once

#include <cstdint>
#include <functional>

namespace quasimc {

/// Runs `work(block, worker)` once for every block in [0, blocks), on `workers` threads, blocks
/// handed out in index order to whoever is free. The first exception thrown stops the rest and is
/// rethrown here. Which worker runs a block is left to chance: results must not depend on `worker`.
void parallel_blocks(
    std::uint64_t blocks,
    unsigned workers,
    const std::function<void(std::uint64_t block, unsigned worker)>& work);

/// `asked` threads, or as many as this process may run at once when `asked` is 0.
[[nodiscard]] unsigned thread_count(unsigned asked);

}  // namespace quasimc

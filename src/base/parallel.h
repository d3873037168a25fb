#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/function_ref.h"

namespace quasimc {

/// Runs `work(block, worker)` once for every block in [0, blocks), on `workers` threads, blocks
/// handed out in index order to whoever is free. The first exception thrown stops the rest and is
/// rethrown here. Which worker runs a block is left to chance: results must not depend on `worker`.
void parallel_blocks(
    std::uint64_t blocks,
    unsigned workers,
    FunctionRef<void(std::uint64_t block, unsigned worker)> work);

/// The same of the blocks from `next` on, which is left behind the last one handed out. Whoever
/// sets it to `blocks` meanwhile ends the handing out: what was handed out is still done.
void parallel_blocks(
    std::atomic<std::uint64_t>& next,
    std::uint64_t blocks,
    unsigned workers,
    FunctionRef<void(std::uint64_t block, unsigned worker)> work);

/// Runs `prepare(block, worker)` for every block in [0, blocks) on `workers` threads, and after it
/// `use(block, worker)` on the same one, but in the order of the blocks and one at a time: what is
/// added up there is the same on any number of threads. The first exception thrown stops the rest
/// and is rethrown here.
void ordered_blocks(
    std::uint64_t blocks,
    unsigned workers,
    FunctionRef<void(std::uint64_t block, unsigned worker)> prepare,
    FunctionRef<void(std::uint64_t block, unsigned worker)> use);

/// Bytes that a core takes from memory at a time.
inline constexpr std::size_t kCacheLine = 64;

/// Sets the size of an empty vector and lets so much room follow that what the next allocation
/// holds lies in other cache lines (two, because they are fetched in pairs).
template <typename T>
void resize_apart(std::vector<T>& values, std::size_t size) {
    values.reserve(size + 2 * kCacheLine / sizeof(T));
    values.resize(size);
}

/// `asked` threads, or as many as this process may run at once when `asked` is 0.
[[nodiscard]] unsigned thread_count(unsigned asked);

}  // namespace quasimc

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/function_ref.h"

namespace quasimc {

/// Runs `work(block, worker)` once for every block in [0, blocks), on `workers` threads; idle
/// threads take blocks in index order. The first exception stops the rest and is rethrown here. The
/// worker of a block is random: results must not depend on `worker`.
void parallel_blocks(
    std::uint64_t blocks,
    unsigned workers,
    FunctionRef<void(std::uint64_t block, unsigned worker)> work);

/// Runs the blocks from `next` on, and leaves it behind the last one that started. Setting it to
/// `blocks` meanwhile starts no more blocks; running ones are completed.
void parallel_blocks(
    std::atomic<std::uint64_t>& next,
    std::uint64_t blocks,
    unsigned workers,
    FunctionRef<void(std::uint64_t block, unsigned worker)> work);

/// Runs `prepare(block, worker)` for every block in [0, blocks) on `workers` threads, and after it
/// `use(block, worker)` on the same thread, but in the order of the blocks and one at a time: sums
/// formed there are the same on any number of threads. The first exception stops the rest and is
/// rethrown here.
void ordered_blocks(
    std::uint64_t blocks,
    unsigned workers,
    FunctionRef<void(std::uint64_t block, unsigned worker)> prepare,
    FunctionRef<void(std::uint64_t block, unsigned worker)> use);

/// Size of a cache line in bytes.
inline constexpr std::size_t kCacheLine = 64;

/// Sets the size of an empty vector, and reserves room behind it that separates the next allocation
/// by cache lines (two, because they are fetched in pairs).
template <typename T>
void resize_apart(std::vector<T>& values, std::size_t size) {
    values.reserve(size + 2 * kCacheLine / sizeof(T));
    values.resize(size);
}

/// `asked` threads, or all available ones when `asked` is 0.
[[nodiscard]] unsigned thread_count(unsigned asked);

}  // namespace quasimc

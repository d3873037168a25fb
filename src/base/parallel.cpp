#include "base/parallel.h"

#ifdef __linux__
#include <sched.h>
#endif

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "base/start_thread.h"

namespace quasimc {

void parallel_blocks(
    std::uint64_t blocks,
    unsigned workers,
    FunctionRef<void(std::uint64_t block, unsigned worker)> work) {
    std::atomic<std::uint64_t> next{0};
    parallel_blocks(next, blocks, workers, work);
}

void parallel_blocks(
    std::atomic<std::uint64_t>& next,
    std::uint64_t blocks,
    unsigned workers,
    FunctionRef<void(std::uint64_t block, unsigned worker)> work) {
    const std::uint64_t begin = std::min(next.load(), blocks);
    std::mutex mutex;
    std::exception_ptr failure;
    const auto loop = [&](unsigned worker) {
        try {
            for (std::uint64_t block = next++; block < blocks; block = next++) {
                work(block, worker);
            }
        } catch (...) {
            const std::lock_guard lock(mutex);
            failure = failure ? failure : std::current_exception();
            next = blocks;
        }
    };
    const auto start = [&](unsigned worker) {
        try {
            return start_thread([&loop, worker] { loop(worker); });
        } catch (const OutOfMemory&) {
            next = blocks;  // for the threads that were started
            throw;
        }
    };
    {
        const auto extra = static_cast<unsigned>(
            std::min<std::uint64_t>(
                std::max(workers, 1U), std::max<std::uint64_t>(blocks - begin, 1)) -
            1);
        std::vector<std::jthread> threads;
        threads.reserve(extra);
        for (unsigned worker = 1; worker <= extra; ++worker) {
            threads.push_back(start(worker));
        }
        loop(0);
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

void ordered_blocks(
    std::uint64_t blocks,
    unsigned workers,
    FunctionRef<void(std::uint64_t block, unsigned worker)> prepare,
    FunctionRef<void(std::uint64_t block, unsigned worker)> use) {
    std::mutex mutex;
    std::condition_variable turned;
    std::uint64_t turn = 0;  // the block that is used next; kFailed: none
    constexpr std::uint64_t kFailed = ~std::uint64_t{0};
    const auto set_turn = [&](std::uint64_t to) {
        const std::lock_guard lock(mutex);
        turn = turn == kFailed ? kFailed : to;
        turned.notify_all();
    };
    parallel_blocks(blocks, workers, [&](std::uint64_t block, unsigned worker) {
        try {
            prepare(block, worker);
            std::unique_lock lock(mutex);
            turned.wait(lock, [&] { return turn == block || turn == kFailed; });
            if (turn == kFailed) {
                return;
            }
            lock.unlock();
            use(block, worker);
        } catch (...) {
            set_turn(kFailed);
            throw;
        }
        set_turn(block + 1);
    });
}

unsigned thread_count(unsigned asked) {
    if (asked > 0) {
        return asked;
    }
#ifdef __linux__
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) {
        return static_cast<unsigned>(std::max(1, CPU_COUNT(&allowed)));
    }
#endif
    return std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace quasimc

#include "base/executor.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/stop.h"

namespace quasimc {

void Executor::run(
    std::uint64_t tasks, const std::function<void(std::uint64_t task, unsigned worker)>& work) {
    const auto range = share_.range(tasks);
    const std::uint64_t begin = range.first;
    parallel_blocks(range.second - begin, workers_, [&](std::uint64_t task, unsigned worker) {
        throw_if_stopped(stop_);
        work(begin + task, worker);
        finish_task(worker);
    });
}

void Executor::finish_task(unsigned worker) {
    constexpr std::chrono::milliseconds kBetween{200};
    const std::uint64_t done = ++done_;
    if (!on_progress_ || worker != 0 || Clock::now() - last_told_ < kBetween) {
        return;
    }
    last_told_ = Clock::now();
    const auto all = static_cast<double>(std::max(announced_, done));
    on_progress_(static_cast<double>(done) / all);
}

}  // namespace quasimc

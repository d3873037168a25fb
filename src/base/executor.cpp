#include "base/executor.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/stop.h"

namespace quasimc {

void Executor::run(
    std::uint64_t tasks,
    const std::function<void(std::uint64_t task, unsigned worker)>& work,
    const std::function<void()>& gather) {
    const auto [begin, end] = share_.range(tasks);
    std::uint64_t next = first_task(begin, end);
    done_ += next - begin;
    done_elsewhere_ += first_task(0, tasks);
    if (team_ != nullptr) {
        run_with_team(next, end, work);
        next = end;
    }
    while (next < end) {
        next = run_until_pause(next, end, work);
        if (next < end) {
            gather();
            pauses_.on_pause(pause_at(next, begin, end));
        }
    }
    before_ += end - begin;
    ++calls_;
}

/// @param begin, end  of the tasks of this call
Pause Executor::pause_at(std::uint64_t next, std::uint64_t begin, std::uint64_t end) const {
    Pause pause{.done = {calls_, next}};
    if (before_ + (end - begin) == announced_) {
        pause.done_of_last = next - begin;
        pause.last = end - begin;
    }
    return pause;
}

/// Runs the tasks [begin, end), as other processes do theirs.
void Executor::run_with_team(std::uint64_t begin, std::uint64_t end, const Work& work) {
    try {
        static_cast<void>(run_until_pause(begin, end, work));
    } catch (...) {
        static_cast<void>(team_->meet(false));
        throw;
    }
    if (!team_->meet(true)) {
        throw StopRequested();
    }
}

/// Runs the tasks [begin, end). @returns the first not done
std::uint64_t Executor::run_until_pause(std::uint64_t begin, std::uint64_t end, const Work& work) {
    std::atomic<std::uint64_t> next{begin}, paused_at{end};
    parallel_blocks(next, end, workers_, [&](std::uint64_t task, unsigned worker) {
        throw_if_stopped(stop_);
        work(task, worker);
        finish_task(worker);
        const bool may_pause = worker == 0 && team_ == nullptr && pauses_.is_due;
        if (may_pause && pauses_.is_due()) {
            paused_at = std::min(paused_at.load(), next.exchange(end));
        }
    });
    return paused_at;
}

/// Of the tasks [begin, end) of this call, the first that is not done already.
std::uint64_t Executor::first_task(std::uint64_t begin, std::uint64_t end) const {
    if (calls_ < done_before_.calls) {
        return end;
    }
    return calls_ == done_before_.calls ? std::clamp(done_before_.task, begin, end) : begin;
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

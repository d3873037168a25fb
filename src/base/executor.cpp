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
    done_elsewhere_ += next - begin;
    while (next < end) {
        next = run_together(next, end, work);
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

/// The tasks [begin, end), with other processes if there are any. @returns the first not done
std::uint64_t Executor::run_together(std::uint64_t begin, std::uint64_t end, const Work& work) {
    if (team_ == nullptr) {
        std::atomic<std::uint64_t> next{begin};
        return run_until_pause({&next, end, true}, begin, end, work);
    }
    std::uint64_t next = end;
    try {
        next = run_until_pause(team_->begin(begin, end), begin, end, work);
    } catch (...) {
        static_cast<void>(team_->meet(TaskTeam::kGivenUp));
        throw;
    }
    next = team_->meet(next);
    if (next == TaskTeam::kGivenUp) {
        throw StopRequested();
    }
    return next;
}

/// The tasks of a range of [begin, end). @returns the first not done, at most `end`
std::uint64_t Executor::run_until_pause(
    const TaskRange& range, std::uint64_t begin, std::uint64_t end, const Work& work) {
    std::atomic<std::uint64_t> paused_at{end};
    const std::uint64_t before = done_;
    parallel_blocks(*range.next, range.end, workers_, [&](std::uint64_t task, unsigned worker) {
        throw_if_stopped(stop_);
        work(task, worker);
        if (team_ != nullptr) {  // others have done some
            done_ = before + std::min(range.next->load(), end) - begin - 1;
        }
        finish_task(worker);
        if (worker == 0 && range.is_all && pauses_.is_due && pauses_.is_due()) {
            paused_at = std::min(paused_at.load(), range.next->exchange(range.end));
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

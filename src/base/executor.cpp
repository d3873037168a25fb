#include "base/executor.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "base/stop.h"

namespace quasimc {

Executor::Executor(unsigned workers, ExecutorOptions options)
    : workers_(workers), options_(std::move(options)) {
    options_.share = options_.team != nullptr ? options_.team->share() : options_.share;
}

TaskRound Executor::begin(std::uint64_t tasks) {
    return {*this, tasks};
}

void Executor::run(std::uint64_t tasks, Work work) {
    begin(tasks).run(tasks, work, [] {});
}

void Executor::give_up() {
    if (options_.team != nullptr && !has_met_) {
        static_cast<void>(options_.team->meet(false));
    }
}

TaskRound::TaskRound(Executor& executor, std::uint64_t tasks)
    : executor_(executor), tasks_of_all_(tasks) {
    const auto [begin, end] = executor.options_.share.range(tasks);
    tasks_ = end - begin;
    executor.part_done_before_ = 0;
}

void TaskRound::run(std::uint64_t tasks, Executor::Work work, FunctionRef<void()> gather) {
    const auto [begin, end] = executor_.options_.share.range(tasks);
    std::uint64_t next = first_task(begin, end);
    done_ += next - begin;
    done_before_ += first_task(0, tasks);
    executor_.part_done_before_ =
        tasks_of_all_ == 0 ? 0
                           : static_cast<double>(done_before_) / static_cast<double>(tasks_of_all_);
    if (executor_.options_.team != nullptr) {
        run_with_team(next, end, work);
        next = end;
    }
    while (next < end) {
        next = run_until_pause(next, end, work);
        if (next < end) {
            gather();
            executor_.options_.watcher->on_pause(pause_at(next, begin, end));
        }
    }
    before_ += end - begin;
    ++calls_;
}

/// @param begin, end  range of the tasks of this call
Pause TaskRound::pause_at(std::uint64_t next, std::uint64_t begin, std::uint64_t end) const {
    Pause pause{.done = {calls_, next}};
    if (before_ + (end - begin) == tasks_) {
        pause.done_of_last = next - begin;
        pause.last = end - begin;
    }
    return pause;
}

/// Runs the tasks [begin, end) while other processes run theirs.
void TaskRound::run_with_team(std::uint64_t begin, std::uint64_t end, Executor::Work work) {
    TaskTeam& team = *executor_.options_.team;
    executor_.has_met_ = true;
    try {
        static_cast<void>(run_until_pause(begin, end, work));
    } catch (...) {
        static_cast<void>(team.meet(false));
        throw;
    }
    if (!team.meet(true)) {
        throw StopRequested();
    }
}

/// Runs the tasks [begin, end). @returns the first incomplete one
std::uint64_t TaskRound::run_until_pause(
    std::uint64_t begin, std::uint64_t end, Executor::Work work) {
    const ExecutorOptions& options = executor_.options_;
    TaskWatcher* pauses = options.team == nullptr ? options.watcher : nullptr;
    std::atomic<std::uint64_t> next{begin}, paused_at{end};
    parallel_blocks(next, end, executor_.workers(), [&](std::uint64_t task, unsigned worker) {
        throw_if_stopped(options.stop);
        work(task, worker);
        finish_task(worker);
        if (worker == 0 && pauses != nullptr && pauses->wants_pause()) {
            paused_at = std::min(paused_at.load(), next.exchange(end));
        }
    });
    return paused_at;
}

/// The first incomplete task of [begin, end) of this call.
std::uint64_t TaskRound::first_task(std::uint64_t begin, std::uint64_t end) const {
    const TaskPosition& done = executor_.options_.done_before;
    if (calls_ < done.calls) {
        return end;
    }
    return calls_ == done.calls ? std::clamp(done.task, begin, end) : begin;
}

void TaskRound::finish_task(unsigned worker) {
    constexpr std::chrono::milliseconds kBetween{200};
    const std::uint64_t done = ++done_;
    TaskWatcher* watcher = executor_.options_.watcher;
    if (watcher == nullptr || worker != 0 || Clock::now() - last_report_ < kBetween) {
        return;
    }
    last_report_ = Clock::now();
    const auto all = static_cast<double>(std::max(tasks_, done));
    watcher->on_progress(static_cast<double>(done) / all);
}

}  // namespace quasimc

#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <utility>

#include "quasimc/share.h"

namespace quasimc {

/// Which tasks are done: those of so many calls of Executor::run(), and of the next call those
/// before a task.
struct TaskPosition {
    std::uint64_t calls = 0, task = 0;
    friend bool operator==(const TaskPosition&, const TaskPosition&) = default;
};

/// No task is at work.
struct Pause {
    TaskPosition done;
    /// Of the last call of those that were announced together, how many tasks are done, and how
    /// many there are; 0 while calls before it are at work.
    std::uint64_t done_of_last = 0, last = 0;
};

/// Now and then no task is at work, so that what was done can be kept.
struct TaskPauses {
    std::function<bool()> is_due;  ///< asked after tasks; costs next to nothing
    std::function<void(const Pause& pause)> on_pause;
};

/// Processes that call the same functions in the same order, and run each its share of the tasks.
struct TaskTeam {
    Share share;  ///< of this process
    /// Says whether this process has done its tasks, or gives them up; returns whether the first
    /// process has done its own, once all have said something.
    std::function<bool(bool is_done)> meet;
};

/// Runs tasks on the threads of this process, and tells how far they are.
class Executor {
  public:
    /// @param workers  threads, at least 1
    /// @param on_progress  called a few times a second, with the part done of what was announced,
    ///        from the thread that called run(). May be empty.
    /// @param stop  asked before every task; work that takes long should ask it as well
    /// @param share  the tasks that are run here
    explicit Executor(
        unsigned workers,
        std::function<void(double)> on_progress = {},
        std::stop_token stop = {},
        Share share = {})
        : workers_(workers),
          on_progress_(std::move(on_progress)),
          stop_(std::move(stop)),
          share_(share) {}

    [[nodiscard]] unsigned workers() const { return workers_; }
    [[nodiscard]] const std::stop_token& stop() const { return stop_; }

    /// Makes pauses from now on. Only of a whole share.
    void set_pauses(TaskPauses pauses) { pauses_ = std::move(pauses); }
    /// Shares tasks with other processes; it must outlive the executor. Only of a whole share,
    /// which has no pauses then.
    void set_team(const TaskTeam* team) {
        team_ = team;
        share_ = team != nullptr ? team->share : Share();
    }
    /// The next calls of run() begin with the tasks after those that are done already.
    void start_at(const TaskPosition& done) {
        done_before_ = done;
        calls_ = 0;
    }

    /// Tells how many tasks the next calls of run() have together.
    void announce(std::uint64_t tasks) {
        const auto [begin, end] = share_.range(tasks);
        announced_ = end - begin;
        announced_to_all_ = tasks;
        done_ = before_ = done_elsewhere_ = 0;
    }
    /// Of the tasks announced last, the part that was done already (start_at()).
    [[nodiscard]] double part_done_before() const {
        return announced_to_all_ == 0
                   ? 0
                   : static_cast<double>(done_elsewhere_) / static_cast<double>(announced_to_all_);
    }

    /// Runs `work(task, worker)` once for every task in [0, tasks) that belongs to the share,
    /// handed out in order to whoever is free. The first exception thrown stops the rest and is
    /// rethrown here. Results must not depend on `worker`, which is below workers().
    /// @param gather  called before every pause: brings together what workers keep for themselves
    /// @throws StopRequested  if a stop was requested before all were done
    void run(
        std::uint64_t tasks,
        const std::function<void(std::uint64_t task, unsigned worker)>& work,
        const std::function<void()>& gather = {});

  private:
    using Clock = std::chrono::steady_clock;
    using Work = std::function<void(std::uint64_t task, unsigned worker)>;
    [[nodiscard]] Pause pause_at(std::uint64_t next, std::uint64_t begin, std::uint64_t end) const;
    [[nodiscard]] std::uint64_t first_task(std::uint64_t begin, std::uint64_t end) const;
    void run_with_team(std::uint64_t begin, std::uint64_t end, const Work& work);
    [[nodiscard]] std::uint64_t run_until_pause(
        std::uint64_t begin, std::uint64_t end, const Work& work);
    void finish_task(unsigned worker);

    unsigned workers_;
    std::function<void(double)> on_progress_;
    std::stop_token stop_;
    Share share_;
    TaskPauses pauses_;
    const TaskTeam* team_ = nullptr;
    TaskPosition done_before_;
    std::uint64_t calls_ = 0;      // of run(), that are complete
    std::uint64_t announced_ = 0;  // of the share
    std::uint64_t announced_to_all_ = 0;
    std::uint64_t before_ = 0;          // tasks of complete calls since the announcement
    std::uint64_t done_elsewhere_ = 0;  // of them, before start_at()
    std::atomic<std::uint64_t> done_{0};
    Clock::time_point last_told_ = Clock::now();
};

}  // namespace quasimc

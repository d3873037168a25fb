#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <stop_token>

#include "base/function_ref.h"
#include "quasimc/share.h"

namespace quasimc {

/// The completed tasks of a round: those of `calls` calls of TaskRound::run(), and those before
/// `task` of the next call.
struct TaskPosition {
    std::uint64_t calls = 0, task = 0;
    friend bool operator==(const TaskPosition&, const TaskPosition&) = default;
};

/// A pause: no task is running.
struct Pause {
    TaskPosition done;
    /// Number of completed tasks, and of all tasks, in the last call of the round; 0 during earlier
    /// calls.
    std::uint64_t done_of_last = 0, last = 0;
};

/// Observes tasks. All functions are called from the thread that called TaskRound::run().
class TaskWatcher {
  public:
    virtual ~TaskWatcher() = default;
    /// Called at the beginning of a round, and a few times a second, with the fraction of completed
    /// tasks.
    virtual void on_progress(double /*part*/) {}
    /// Whether to pause; called between tasks.
    [[nodiscard]] virtual bool wants_pause() { return false; }
    virtual void on_pause(const Pause& /*pause*/) {}

  protected:
    TaskWatcher() = default;
};

/// Processes that call the same functions in the same order, and each run their share of the tasks.
class TaskTeam {
  public:
    virtual ~TaskTeam() = default;
    /// The share of this process.
    [[nodiscard]] virtual Share share() const = 0;
    /// Reports whether this process has completed or abandoned its tasks; waits for all processes,
    /// and returns whether the first one has completed its own.
    [[nodiscard]] virtual bool meet(bool is_done) = 0;

  protected:
    TaskTeam() = default;
};

/// Options of an executor.
struct ExecutorOptions {
    /// Checked before every task; long tasks should check it as well.
    std::stop_token stop = {};
    Share share = {};                ///< tasks to run here
    TaskWatcher* watcher = nullptr;  ///< shares and teams make no pauses
    TaskTeam* team = nullptr;        ///< replaces `share`
    TaskPosition done_before = {};   ///< for every round: tasks before it are skipped
};

class TaskRound;

/// Runs tasks on the threads of this process.
class Executor {
  public:
    using Work = FunctionRef<void(std::uint64_t task, unsigned worker)>;

    /// @param workers  threads, at least 1
    explicit Executor(unsigned workers, ExecutorOptions options = {});

    [[nodiscard]] unsigned workers() const { return workers_; }
    [[nodiscard]] const std::stop_token& stop() const { return options_.stop; }

    /// Begins a round with a known number of tasks, which may be run in several calls.
    [[nodiscard]] TaskRound begin(std::uint64_t tasks);
    /// Runs a round of one call, like TaskRound::run().
    void run(std::uint64_t tasks, Work work);
    /// Reports to the team, unless it has met, that this process runs no tasks.
    void give_up();
    /// The fraction of tasks of the last round that was skipped (done_before).
    [[nodiscard]] double part_done_before() const { return part_done_before_; }

  private:
    friend class TaskRound;

    unsigned workers_;
    ExecutorOptions options_;
    double part_done_before_ = 0;
    bool has_met_ = false;  // with its team
};

/// A group of tasks, run in one or several calls.
class TaskRound {
  public:
    [[nodiscard]] unsigned workers() const { return executor_.workers(); }

    /// Runs `work(task, worker)` once for every task in [0, tasks) of the share. Idle workers take
    /// tasks in order. The first exception stops the rest and is rethrown here. Results must not
    /// depend on `worker`, which is below workers().
    /// @param gather  called at every pause, before the watcher: collects the private data of
    /// workers
    /// @throws StopRequested  if a stop was requested before all were complete
    void run(std::uint64_t tasks, Executor::Work work, FunctionRef<void()> gather);

  private:
    friend class Executor;
    using Clock = std::chrono::steady_clock;

    TaskRound(Executor& executor, std::uint64_t tasks);
    [[nodiscard]] Pause pause_at(std::uint64_t next, std::uint64_t begin, std::uint64_t end) const;
    [[nodiscard]] std::uint64_t first_task(std::uint64_t begin, std::uint64_t end) const;
    void run_with_team(std::uint64_t begin, std::uint64_t end, Executor::Work work);
    [[nodiscard]] std::uint64_t run_until_pause(
        std::uint64_t begin, std::uint64_t end, Executor::Work work);
    void finish_task(unsigned worker);

    Executor& executor_;
    std::uint64_t tasks_of_all_, tasks_;  // of all processes; of the share
    std::uint64_t calls_ = 0;             // completed calls of run()
    std::uint64_t before_ = 0;            // tasks of completed calls
    std::uint64_t done_before_ = 0;       // skipped tasks of all processes
    std::atomic<std::uint64_t> done_{0};
    Clock::time_point last_report_;  // the first task is reported at once: rounds may be short
};

}  // namespace quasimc

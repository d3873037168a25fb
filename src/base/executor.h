#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <stop_token>

#include "base/function_ref.h"
#include "quasimc/share.h"

namespace quasimc {

/// Which tasks of a round are done: those of so many calls of TaskRound::run(), and of the next
/// call those before a task.
struct TaskPosition {
    std::uint64_t calls = 0, task = 0;
    friend bool operator==(const TaskPosition&, const TaskPosition&) = default;
};

/// No task is at work.
struct Pause {
    TaskPosition done;
    /// Of the last call of the round, how many tasks are done, and how many there are; 0 while
    /// calls before it are at work.
    std::uint64_t done_of_last = 0, last = 0;
};

/// Watches tasks. All functions are called from the thread that called TaskRound::run().
class TaskWatcher {
  public:
    virtual ~TaskWatcher() = default;
    /// Is called at the beginning of a round, and a few times a second, with the part of its tasks
    /// that is done.
    virtual void on_progress(double /*part*/) {}
    /// Whether no task should be at work for a while; asked after tasks.
    [[nodiscard]] virtual bool wants_pause() { return false; }
    virtual void on_pause(const Pause& /*pause*/) {}

  protected:
    TaskWatcher() = default;
};

/// Processes that call the same functions in the same order, and run each its share of the tasks.
class TaskTeam {
  public:
    virtual ~TaskTeam() = default;
    /// That of this process.
    [[nodiscard]] virtual Share share() const = 0;
    /// Says whether this process has done its tasks, or gives them up; returns whether the first
    /// process has done its own, once all have said something.
    [[nodiscard]] virtual bool meet(bool is_done) = 0;

  protected:
    TaskTeam() = default;
};

/// How an executor runs tasks.
struct ExecutorOptions {
    /// Asked before every task; work that takes long should ask it as well.
    std::stop_token stop = {};
    Share share = {};                ///< the tasks that are run here
    TaskWatcher* watcher = nullptr;  ///< makes no pauses of a share or a team
    TaskTeam* team = nullptr;        ///< whose share counts
    TaskPosition done_before = {};   ///< of every round: it begins with the tasks after these
};

class TaskRound;

/// The threads of this process, and how they run tasks.
class Executor {
  public:
    using Work = FunctionRef<void(std::uint64_t task, unsigned worker)>;

    /// @param workers  threads, at least 1
    explicit Executor(unsigned workers, ExecutorOptions options = {});

    [[nodiscard]] unsigned workers() const { return workers_; }
    [[nodiscard]] const std::stop_token& stop() const { return options_.stop; }

    /// Begins tasks whose number in all is known, which may be run in several calls.
    [[nodiscard]] TaskRound begin(std::uint64_t tasks);
    /// A round of one call: as TaskRound::run().
    void run(std::uint64_t tasks, Work work);
    /// Tells the team, if there is one that has not met, that no task is run here.
    void give_up();
    /// The part of the tasks of the last round that was done already (done_before).
    [[nodiscard]] double part_done_before() const { return part_done_before_; }

  private:
    friend class TaskRound;

    unsigned workers_;
    ExecutorOptions options_;
    double part_done_before_ = 0;
    bool has_met_ = false;  // its team
};

/// Tasks that are run together.
class TaskRound {
  public:
    [[nodiscard]] unsigned workers() const { return executor_.workers(); }

    /// Runs `work(task, worker)` once for every task in [0, tasks) that belongs to the share,
    /// handed out in order to whoever is free. The first exception thrown stops the rest and is
    /// rethrown here. Results must not depend on `worker`, which is below workers().
    /// @param gather  called at every pause, before the watcher: brings together what workers keep
    ///        for themselves
    /// @throws StopRequested  if a stop was requested before all were done
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
    std::uint64_t calls_ = 0;             // of run(), that are complete
    std::uint64_t before_ = 0;            // tasks of complete calls
    std::uint64_t done_before_ = 0;       // of all processes, that were done already
    std::atomic<std::uint64_t> done_{0};
    Clock::time_point last_report_;  // the first task is reported at once: rounds may be short
};

}  // namespace quasimc

#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <utility>

#include "quasimc/share.h"

namespace quasimc {

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

    /// Tells how many tasks the next calls of run() have together.
    void announce(std::uint64_t tasks) {
        const auto [begin, end] = share_.range(tasks);
        announced_ = end - begin;
        done_ = 0;
    }

    /// Runs `work(task, worker)` once for every task in [0, tasks) that belongs to the share,
    /// handed out in order to whoever is free. The first exception thrown stops the rest and is
    /// rethrown here. Results must not depend on `worker`, which is below workers().
    /// @throws StopRequested  if a stop was requested before all were done
    void run(
        std::uint64_t tasks, const std::function<void(std::uint64_t task, unsigned worker)>& work);

  private:
    using Clock = std::chrono::steady_clock;
    void finish_task(unsigned worker);

    unsigned workers_;
    std::function<void(double)> on_progress_;
    std::stop_token stop_;
    Share share_;
    std::uint64_t announced_ = 0;
    std::atomic<std::uint64_t> done_{0};
    Clock::time_point last_told_ = Clock::now();
};

}  // namespace quasimc

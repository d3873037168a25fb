#pragma once

#include <csignal>
#include <functional>
#include <thread>

namespace quasimc {

/// Handles SIGTERM, SIGINT and SIGHUP in its own thread, also during a computation or a wait.
/// Ignored signals stay ignored, as in programs that a shell starts in the background. Create it
/// before any other thread.
class StopSignals {
  public:
    /// @param on_signal  called from the thread, with the number of the signal
    explicit StopSignals(std::function<void(int)> on_signal);
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

  private:
    void wait();

    std::function<void(int)> on_signal_;
    sigset_t before_{};
    int signals_ = -1, end_ = -1;  // descriptors
    std::thread thread_;
};

}  // namespace quasimc

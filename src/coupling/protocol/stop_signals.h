#pragma once

#include <csignal>
#include <functional>
#include <thread>

namespace quasimc {

/// Takes SIGTERM, SIGINT and SIGHUP in a thread of its own, whatever the others do: in the middle
/// of a computation, or waiting. One that is ignored stays so (the shell starts programs in the
/// background so). Make it before any other thread.
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

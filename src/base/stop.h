#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>

namespace quasimc {

/// Thrown where work ends early because a stop was requested.
class StopRequested : public std::exception {
  public:
    [[nodiscard]] const char* what() const noexcept override { return "a stop was requested"; }
};

/// Checks for a stop. Long computations call it often: it costs a read of memory.
/// @throws StopRequested  if a stop was requested
inline void throw_if_stopped(const std::stop_token& stop) {
    if (stop.stop_requested()) [[unlikely]] {
        throw StopRequested();
    }
}

/// Requests a stop at a point in time, from a thread of its own.
class StopAlarm {
  public:
    using Clock = std::chrono::steady_clock;

    explicit StopAlarm(std::stop_source& source) : source_(source) {}
    ~StopAlarm() = default;
    StopAlarm(const StopAlarm&) = delete;
    StopAlarm& operator=(const StopAlarm&) = delete;

    /// Sets the time, replacing an earlier one.
    void set(Clock::time_point at);

  private:
    void wait(const std::stop_token& ends);

    std::stop_source& source_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    Clock::time_point at_;  // guarded by mutex_
    std::jthread thread_;   // started by set(); last, so that it ends first
};

}  // namespace quasimc

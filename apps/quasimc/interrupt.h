#pragma once

#include <csignal>
#include <functional>
#include <stop_token>
#include <thread>

/// Handles Ctrl-C (SIGINT) during its lifetime: the first requests a stop, the second ends the
/// program at once. Does nothing if SIGINT is ignored, as in the background of a shell. Must be
/// made before other threads, which inherit the blocked signal: a separate thread waits for it.
class InterruptWatch {
  public:
    /// @param on_first  called at the first signal, from a separate thread
    explicit InterruptWatch(std::function<void()> on_first);
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    [[nodiscard]] std::stop_token token() const { return asked_.get_token(); }
    void wait_for_first() const;

  private:
    void wait(const std::stop_token& ends);

    std::function<void()> on_first_;
    std::stop_source asked_;
    sigset_t signals_{}, before_{};
    std::jthread thread_;
};

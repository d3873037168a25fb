#pragma once

#include <csignal>
#include <functional>
#include <stop_token>
#include <thread>

/// Ctrl-C (SIGINT), from the making of this object to its end: the first asks for a stop, the
/// second ends the program at once. Not where SIGINT is ignored, as in the background of a shell.
/// Must be made before other threads are: it is a thread of its own that waits for the signal, and
/// all others inherit that they don't.
class InterruptWatch {
  public:
    /// @param on_first  called when the first comes, from a thread of its own
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

#include "interrupt.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

#include <pthread.h>
#include <unistd.h>

#include "base/start_thread.h"
#include "command_line.h"

InterruptWatch::InterruptWatch(std::function<void()> on_first) : on_first_(std::move(on_first)) {
    struct sigaction now {};
    ::sigaction(SIGINT, nullptr, &now);
    if (now.sa_handler == SIG_IGN) {
        return;
    }
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    ::pthread_sigmask(SIG_BLOCK, &signals_, &before_);
    thread_ = quasimc::start_thread([this](const std::stop_token& ends) { wait(ends); });
}

InterruptWatch::~InterruptWatch() {
    if (thread_.joinable()) {
        thread_.request_stop();
        ::pthread_kill(thread_.native_handle(), SIGINT);  // wakes it up
        thread_.join();
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
}

void InterruptWatch::wait(const std::stop_token& ends) {
    // The program `timeout` sends a signal twice.
    constexpr std::chrono::milliseconds kTwice{50};
    using Clock = std::chrono::steady_clock;
    Clock::time_point first;
    int signal = 0;
    while (::sigwait(&signals_, &signal) == 0 && !ends.stop_requested()) {
        if (stop_.stop_requested()) {
            if (Clock::now() - first < kTwice) {
                continue;
            }
            ::_exit(static_cast<int>(Exit::interrupted));
        }
        first = Clock::now();
        on_first_();
        stop_.request_stop();
    }
}

void InterruptWatch::wait_for_first() const {
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock lock(mutex);
    never.wait(lock, token(), [] { return false; });
}

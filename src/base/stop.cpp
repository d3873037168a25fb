#include "base/stop.h"

#include "base/start_thread.h"

namespace quasimc {

void StopAlarm::set(Clock::time_point at) {
    {
        const std::lock_guard lock(mutex_);
        at_ = at;
    }
    changed_.notify_all();
    if (!thread_.joinable()) {
        thread_ = start_thread([this](const std::stop_token& ends) { wait(ends); });
    }
}

void StopAlarm::wait(const std::stop_token& ends) {
    std::unique_lock lock(mutex_);
    while (!ends.stop_requested()) {
        const Clock::time_point at = at_;
        if (Clock::now() >= at) {
            source_.request_stop();
            return;
        }
        changed_.wait_until(lock, ends, at, [&] { return at_ != at; });
    }
}

}  // namespace quasimc

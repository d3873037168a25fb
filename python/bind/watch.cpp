#include "watch.h"

#include <chrono>
#include <utility>

namespace quasimc::python {

void WatchedWork::do_work(const Task& task) {
    try {
        task({.stop = stop_.get_token(), .listeners = {this}});
    } catch (...) {
        thrown_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    done_ = true;
    changed_.notify_all();
}

void WatchedWork::run(const Task& task) {
    {
        const py::gil_scoped_release release;
        const std::jthread worker([&] { do_work(task); });
        watch();
    }
    const bool by_key = interrupt_ && interrupt_->matches(PyExc_KeyboardInterrupt);
    if (interrupt_ && (thrown_ || !by_key)) {
        throw *interrupt_;
    }
    if (thrown_) {
        std::rethrow_exception(thrown_);
    }
}

void WatchedWork::on_progress(const Progress& progress) {
    const std::lock_guard lock(mutex_);
    latest_ = progress;
}

void WatchedWork::watch() {
    constexpr std::chrono::milliseconds kInterval{50};
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, kInterval, [&] { return done_; })) {
        lock.unlock();
        listen();
        lock.lock();
    }
    lock.unlock();
    listen();
}

void WatchedWork::listen() {
    const py::gil_scoped_acquire acquire;
    if (interrupt_) {
        return;
    }
    std::optional<Progress> news;
    {
        const std::lock_guard lock(mutex_);
        news = std::exchange(latest_, std::nullopt);
    }
    try {
        if (PyErr_CheckSignals() != 0) {
            throw py::error_already_set();
        }
        if (news && !on_progress_.is_none()) {
            on_progress_(
                news->fraction, news->seconds, news->expected_seconds, news->fraction_at_target);
        }
    } catch (py::error_already_set& error) {
        interrupt_.emplace(std::move(error));
        stop_.request_stop();
    }
}

}  // namespace quasimc::python

#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "bind.h"
#include "quasimc/run.h"

namespace quasimc::python {

/// Runs work in another thread without the interpreter lock, while this thread reports its progress
/// to Python and handles signals. Ctrl-C, or an exception of the callback, requests a stop.
class WatchedWork final : private RunListener {
  public:
    /// @param on_progress  Python function, called with (fraction, seconds, expected_seconds,
    ///        fraction_at_target); or None
    explicit WatchedWork(py::object on_progress) : on_progress_(std::move(on_progress)) {}

    /// Work that stops, and reports its progress, through a control.
    using Task = std::function<void(const RunControl& control)>;

    /// @throws the exception of the work or of the callback; KeyboardInterrupt, if the work ended
    ///         without a result
    void run(const Task& task);

  private:
    void do_work(const Task& task);
    void watch();
    void on_progress(const Progress& progress) override;
    [[nodiscard]] bool wants(SeriesPart /*part*/) const override { return false; }
    void listen();

    py::object on_progress_;
    std::stop_source stop_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Progress> latest_;
    bool done_ = false;
    std::exception_ptr thrown_;                       // by the work
    std::optional<py::error_already_set> interrupt_;  // the exception that requested the stop
};

}  // namespace quasimc::python

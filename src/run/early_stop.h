#pragma once

#include <stop_token>
#include <utility>

#include "base/stop.h"
#include "quasimc/run.h"

namespace quasimc {

/// Stops a run early: on a request of its caller, or at a point in time.
class EarlyStop {
  public:
    /// @param asked  the caller's stop token
    explicit EarlyStop(std::stop_token asked)
        : asked_(std::move(asked)), forward_(asked_, Forward{&source_}) {}

    /// Sets the time of the stop, replacing an earlier one. The largest time point: never.
    void stop_at(Deadline::Clock::time_point at);

    [[nodiscard]] std::stop_token token() const { return source_.get_token(); }
    /// Whether a stop is possible.
    [[nodiscard]] bool is_possible() const { return has_limit_ || asked_.stop_possible(); }
    /// Reason of the stop.
    [[nodiscard]] StopReason why() const {
        return asked_.stop_requested() ? StopReason::interrupted : StopReason::time_limit;
    }

  private:
    struct Forward {
        std::stop_source* source;
        void operator()() const { source->request_stop(); }
    };

    std::stop_token asked_;
    std::stop_source source_;
    std::stop_callback<Forward> forward_;
    StopAlarm alarm_{source_};
    bool has_limit_ = false;
};

}  // namespace quasimc

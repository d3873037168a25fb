#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

#include "quasimc/run.h"
#include "run/round_tracer.h"

namespace quasimc {

/// Tells those who look on at a run (RunControl::preview) what it has brought so far. What this
/// costs is a small part of the run's time.
class PreviewTeller {
  public:
    /// @param evaluate  the result of sums; it must outlive the object, as the control must
    PreviewTeller(const RunControl& control, std::function<Result(const Sums&)> evaluate)
        : preview_(control.preview), moment_(control.moment), evaluate_(std::move(evaluate)) {}

    /// Tells of the first round replicate by replicate. The tracer ends before this object.
    void watch(RoundTracer& tracer);
    /// Tells of the rounds that are complete, now that another follows.
    void begin_round(const Round& round, const RoundTracer& tracer);

  private:
    [[nodiscard]] bool is_due() const;
    void tell_replicates(const Pause& pause, const Sums& partial, const RoundTracer& tracer);
    void tell(const Sums& sums);

    using Clock = std::chrono::steady_clock;
    const RunPreview* preview_;
    std::size_t moment_;
    std::function<Result(const Sums&)> evaluate_;
    Round round_;
    std::size_t told_ = 0;          // replicates of the round
    Clock::time_point not_before_;  // the next result
    Clock::time_point ask_after_;   // the next pause
};

}  // namespace quasimc

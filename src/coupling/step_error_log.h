#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <string>

#include "coupling/environment.h"

namespace quasimc {

/// Reports the faults of a session, equal consecutive ones once, and records the worst outcome.
class StepErrorLog {
  public:
    /// @param send  outlives the object
    explicit StepErrorLog(const std::function<void(const std::string&)>& send) : send_(send) {}

    /// @param fault  of the step; null if it had none
    void report_step(std::uint64_t step, const std::exception_ptr& fault);
    /// Reports a fault before the first step.
    void report_rejection(const std::exception_ptr& fault);
    [[nodiscard]] SessionOutcome worst() const { return worst_; }

  private:
    std::string describe(const std::exception_ptr& fault);

    const std::function<void(const std::string&)>& send_;
    std::string last_;  // fault of the last step; empty if it had none
    SessionOutcome worst_ = SessionOutcome::good;
};

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <string>

#include "coupling/environment.h"

namespace quasimc {

/// Tells what goes wrong in a conversation, once as long as it stays the same, and keeps the worst
/// of it.
class StepErrorLog {
  public:
    /// @param tell  outlives the object
    explicit StepErrorLog(const std::function<void(const std::string&)>& send) : send_(send) {}

    /// @param fault  of the step; none: it was good
    void report_step(std::uint64_t step, const std::exception_ptr& fault);
    /// Of what is refused before the first step.
    void report_rejection(const std::exception_ptr& fault);
    [[nodiscard]] SessionOutcome worst() const { return worst_; }

  private:
    std::string words_of(const std::exception_ptr& fault);

    const std::function<void(const std::string&)>& send_;
    std::string last_;  // of the step before; empty: it was good
    SessionOutcome worst_ = SessionOutcome::good;
};

}  // namespace quasimc

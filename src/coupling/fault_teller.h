#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <string>

#include "coupling/environment.h"

namespace quasimc {

/// Tells what goes wrong in a conversation, once as long as it stays the same, and keeps the worst
/// of it.
class FaultTeller {
  public:
    /// @param tell  outlives the object
    explicit FaultTeller(const std::function<void(const std::string&)>& tell) : tell_(tell) {}

    /// @param fault  of the step; none: it was good
    void tell_step(std::uint64_t step, const std::exception_ptr& fault);
    /// Of what is refused before the first step.
    void tell_refusal(const std::exception_ptr& fault);
    [[nodiscard]] Conversation worst() const { return worst_; }

  private:
    std::string words_of(const std::exception_ptr& fault);

    const std::function<void(const std::string&)>& tell_;
    std::string last_;  // of the step before; empty: it was good
    Conversation worst_ = Conversation::good;
};

}  // namespace quasimc

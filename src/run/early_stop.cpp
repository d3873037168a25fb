#include "run/early_stop.h"

#include <algorithm>
#include <chrono>

namespace quasimc {

void EarlyStop::stop_at(Deadline::Clock::time_point at) {
    constexpr std::chrono::hours kForever{1 << 18U};  // longer waits may overflow
    if (!has_limit_ && at == Deadline::Clock::time_point::max()) {
        return;
    }
    has_limit_ = at < Deadline::Clock::time_point::max();
    alarm_.set(std::min(at, Deadline::Clock::now() + kForever));
}

}  // namespace quasimc

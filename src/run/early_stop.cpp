#include "run/early_stop.h"

#include <algorithm>

namespace quasimc {

void EarlyStop::set_limit(double seconds) {
    constexpr double kForever = 1e9;  // more may not be a time of the clock
    const std::chrono::duration<double> limit(std::min(seconds, kForever));
    has_limit_ = true;
    alarm_.set(start_ + std::chrono::duration_cast<StopAlarm::Clock::duration>(limit));
}

}  // namespace quasimc

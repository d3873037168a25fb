#include <algorithm>
#include <limits>

#include "quasimc/run.h"
#include "run/run_control.h"

namespace quasimc {
namespace {

Deadline::Clock::duration duration_of(double seconds) {
    constexpr double kForever = 1e9;  // later times may overflow the clock
    return std::chrono::duration_cast<Deadline::Clock::duration>(
        std::chrono::duration<double>(std::min(seconds, kForever)));
}

constexpr double kMinGrace = 0.25;

}  // namespace

Deadline Deadline::after(double seconds, std::optional<double> grace) {
    constexpr double kPart = 0.03;
    const Clock::time_point at = Clock::now() + duration_of(seconds);
    return {at, at + duration_of(grace.value_or(std::max(kMinGrace, kPart * seconds)))};
}

double Deadline::seconds_left(Clock::time_point now) const {
    return is_never() ? std::numeric_limits<double>::infinity()
                      : std::chrono::duration<double>(at_ - now).count();
}

Deadline Deadline::share(double part) const {
    if (is_never()) {
        return *this;
    }
    constexpr double kLeast = 1e-3;
    const Clock::time_point now = Clock::now();
    const double left = std::max(seconds_left(now), kLeast);
    return {now + duration_of(part * left), now + duration_of(left + kMinGrace)};
}

Deadline deadline_of(const RunControl& control, const RunSpec& spec) {
    const bool is_by_spec = control.deadline.is_never() && spec.max_seconds > 0;
    return is_by_spec ? Deadline::after(spec.max_seconds) : control.deadline;
}

}  // namespace quasimc

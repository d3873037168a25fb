#include <algorithm>
#include <chrono>
#include <utility>

#include "quasimc/run.h"
#include "run/run_control.h"

namespace quasimc {

struct Work::Whole {
    std::vector<RunListener*> listeners;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    double fraction = 0;
};

Work::Work(std::vector<RunListener*> listeners)
    : whole_(std::make_shared<Whole>(Whole{.listeners = std::move(listeners)})) {}

Work Work::part(double begin, double share) const {
    Work part = *this;
    part.begin_ += share_ * begin;
    part.share_ *= share;
    return part;
}

void Work::report(double fraction, double at_target) const {
    if (!whole_) {
        return;
    }
    // Progress does not decrease when a run restarts.
    whole_->fraction = std::max(whole_->fraction, begin_ + share_ * fraction);
    const double done = whole_->fraction;
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - whole_->start).count();
    for (RunListener* listener : whole_->listeners) {
        listener->on_progress({done, seconds, done > 0 ? seconds / done : 0, at_target});
    }
}

Work work_of(const RunControl& control) {
    return control.work.is_empty() ? Work(control.listeners) : control.work;
}

}  // namespace quasimc

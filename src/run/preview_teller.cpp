#include "run/preview_teller.h"

#include <algorithm>
#include <utility>

#include "sums/sum_data.h"

namespace quasimc {
void PreviewTeller::watch(RoundTracer& tracer) {
    if (preview_ != nullptr) {
        tracer.add_watcher(
            {[this] { return Clock::now() >= ask_after_ && is_due(); },
             [this, &tracer](const Pause& pause, const Sums& partial) {
                 tell_replicates(pause, partial, tracer);
             }});
    }
}

void PreviewTeller::begin_round(const Round& round, const RoundTracer& tracer) {
    round_ = round;
    told_ = 0;
    if (preview_ != nullptr && tracer.has_sums() && is_due()) {
        tell(tracer.sums());
    }
}

bool PreviewTeller::is_due() const {
    return Clock::now() >= not_before_ && preview_->is_wanted();
}

/// Later rounds add to replicates that are told of already: their first replicates alone would tell
/// less than all have told.
void PreviewTeller::tell_replicates(
    const Pause& pause, const Sums& partial, const RoundTracer& tracer) {
    const std::size_t all = partial->replicates.size();
    const std::uint64_t done = pause.last > 0 ? pause.done_of_last * all / pause.last : 0;
    constexpr std::size_t kFewest = 2;  // for an error
    if (round_.first > 0 || done < kFewest || done <= told_) {
        constexpr std::chrono::milliseconds kPatience{20};  // a pause for nothing costs as well
        ask_after_ = Clock::now() + kPatience;
        return;
    }
    told_ = done;
    tell(first_replicates(partial, done, round_.count, tracer.samples_of(round_)));
}

void PreviewTeller::tell(const Sums& sums) {
    constexpr std::chrono::milliseconds kBetween{300};
    constexpr int kMostOften = 20;  // once in so many times the time that it takes
    const Clock::time_point start = Clock::now();
    preview_->on_result(moment_, evaluate_(sums));
    const Clock::time_point end = Clock::now();
    not_before_ = end + std::max<Clock::duration>(kBetween, kMostOften * (end - start));
}

}  // namespace quasimc

#include "series/series_walk.h"

#include <algorithm>

namespace quasimc {

void walk_series(const SeriesInput& input, SeriesSteps& steps, SeriesSummary& summary) {
    const std::vector<TimeStep>& times = input.time_steps;
    while (summary.completed < times.size()) {
        try {
            steps.compute(summary.completed);
        } catch (const Stopped& stopped) {
            if (summary.completed == 0) {
                throw;
            }
            end_series(stopped.why(), summary);
            return;
        }
        const std::size_t i = summary.completed++;
        if (i + 1 == times.size() || times[i + 1].day != times[i].day) {
            steps.finish_day(i);
        }
    }
}

void end_series(StopReason why, SeriesSummary& summary) {
    if (summary.stop != StopReason::interrupted) {
        summary.stop = why;
    }
}

bool is_requested(SeriesPart part, const RunControl& control) {
    const auto& listeners = control.listeners;
    return (listeners.empty() && part == SeriesPart::total) ||
           std::any_of(listeners.begin(), listeners.end(), [&](const RunListener* listener) {
               return listener->wants(part);
           });
}

void report_time_step(const RunControl& control, const TimeStepResult& step) {
    for (RunListener* listener : control.listeners) {
        if (listener->wants(SeriesPart::time_steps)) {
            listener->on_time_step(step);
        }
    }
}

void report_day(const RunControl& control, std::size_t day, const SeriesSum& sum) {
    for (RunListener* listener : control.listeners) {
        if (listener->wants(SeriesPart::days)) {
            listener->on_day(day, sum);
        }
    }
}

void report_sums(const RunControl& control, const SeriesSums& sums) {
    for (RunListener* listener : control.listeners) {
        if (listener->wants(SeriesPart::sums)) {
            listener->on_sums(sums);
        }
    }
}

}  // namespace quasimc

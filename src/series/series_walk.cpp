#include "series/series_walk.h"

namespace quasimc {

void walk_series(const SeriesInput& input, const SeriesSteps& steps, SeriesSummary& summary) {
    const std::vector<TimeStep>& times = input.time_steps;
    while (summary.done < times.size()) {
        try {
            steps.compute(summary.done);
        } catch (const Stopped& stopped) {
            if (summary.done == 0) {
                throw;
            }
            end_series(stopped.why(), summary);
            return;
        }
        const std::size_t i = summary.done++;
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

}  // namespace quasimc

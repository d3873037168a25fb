#include "run/shared_series.h"

#include <memory>
#include <utility>

namespace quasimc {
namespace {

/// The first moment behind those of which a checkpoint has a state.
std::size_t first_not_kept(std::size_t moments, const RunCheckpoint* checkpoint) {
    std::size_t first = checkpoint != nullptr ? moments : 0;
    while (first > 0 && !checkpoint->has_state(first - 1)) {
        --first;
    }
    return first;
}

}  // namespace

SharedSeries::SharedSeries(
    Simulator& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const std::vector<TimeStepPlan>& plans,
    const RunSpec& spec,
    const SeriesEvents& events)
    : events_(events) {
    if (events.team == nullptr || events.traced_runs != nullptr || events.sums_of) {
        return;
    }
    first_ = first_not_kept(time_steps.size(), events.checkpoint);
    jobs_ = jobs_of_series(plans, spec, first_, events.team->size);
    trace_ = series_tracer(simulator, scene, time_steps, plans, spec);
}

bool SharedSeries::has(std::size_t moment) const {
    return events_.traced_runs != nullptr || (!jobs_.empty() && moment >= first_);
}

std::optional<TracedRun> SharedSeries::take(std::size_t moment, const RunControl& control) {
    if (events_.traced_runs != nullptr) {
        return events_.traced_runs->take(moment, control);
    }
    if (!runs_) {
        const TeamOrder order{
            .is_runs = TeamOrder::kTimes, .point = events_.team->point, .moment = first_};
        runs_ = std::make_unique<TeamRuns>(*events_.team, order, jobs_, trace_);
    }
    return runs_->take(moment, control);
}

RunCheckpoint checkpoint_of(std::optional<RunState> state, const RunCheckpoint* kept) {
    RunCheckpoint hooks;
    if (kept != nullptr) {
        hooks = *kept;
    } else {
        hooks.has_state = [](std::size_t) { return false; };
        hooks.is_due = [] { return false; };
        hooks.save = [](std::size_t, const RunSnapshot&) {};
        hooks.finish = hooks.save;
        hooks.keep = [](std::size_t, const std::string&) {};
        hooks.flush = [] {};
    }
    const auto given = std::make_shared<std::optional<RunState>>(std::move(state));
    hooks.state_of = [given](std::size_t) { return std::exchange(*given, std::nullopt); };
    return hooks;
}

}  // namespace quasimc

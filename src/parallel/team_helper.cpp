#include "parallel/team_helper.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <stop_token>

#include "base/executor.h"
#include "base/parallel.h"
#include "base/stop.h"
#include "run/plan_run.h"
#include "run/round_tracer.h"
#include "samplers/catalogue.h"
#include "series/trace_spec.h"
#include "transport/prepared_scene.h"

namespace quasimc {
namespace {

/// Progress that looks whether the first process asks to give up.
std::function<void(double)> stop_with(const RunTeam& team, std::stop_source& stop) {
    return [&team, &stop](double) {
        if (team.is_stopped()) {
            stop.request_stop();
        }
    };
}

}  // namespace

TeamOrder TeamHelper::help(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const RunTeam& team,
    TeamOrder order) {
    const std::vector<Trace> traces = traces_of(scene, time_steps, spec);
    const std::uint64_t point = order.point;
    while (order.kind == TeamOrder::kTrace && order.point == point) {
        const auto trace = std::find_if(traces.begin(), traces.end(), [&](const Trace& each) {
            return each.time_step == order.moment;
        });
        order = help_moment(scene, time_steps[order.moment].sources, trace->spec, team, order);
    }
    return order;
}

TeamOrder TeamHelper::help_moment(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunTeam& team,
    TeamOrder order) {
    RunSpec planned = spec;
    planned.method = plan_run(scene, sources, spec, caster_, {}).method;
    const PreparedScene prepared(
        scene, sources, planned.window, caster_.caster_for(scene, planned.engine, {}), {});
    const std::unique_ptr<Sampler> sampler = make_sampler(planned.sampler);
    const TeamOrder first = order;
    std::stop_source stop;  // by the first process
    Executor executor(thread_count(planned.threads), stop_with(team, stop), stop.get_token());
    RoundTracer tracer(prepared, *sampler, planned, executor, false);
    tracer.set_team(&team);
    while (order.kind == TeamOrder::kTrace && order.point == first.point &&
           order.moment == first.moment) {
        try {
            tracer.help(order);
        } catch (const StopRequested&) {  // the first process ends the run
        }
        order = team.order({});
    }
    return order;
}

}  // namespace quasimc

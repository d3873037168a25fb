#include "parallel/team_helper.h"

#include <algorithm>
#include <memory>
#include <stop_token>

#include "base/executor.h"
#include "base/stop.h"
#include "parallel/stop_by_team.h"
#include "run/plan_run.h"
#include "run/round_solver.h"
#include "run/trace_plan.h"
#include "samplers/catalogue.h"
#include "series/trace_spec.h"
#include "transport/prepared_scene.h"

namespace quasimc {
namespace {

/// Traces or prepares tasks of a round on an order of the first process.
void help_round(
    RoundSolver& solver,
    const PreparedScene& prepared,
    const TeamOrder& order,
    TaskWatcher& watcher) {
    if (prepared.lights().empty()) {
        return;
    }
    if (order.is_prepare != 0) {
        static_cast<void>(solver.solver_for(order.first_paths));
        return;
    }
    Sums sums = solver.empty_sums(order.first_paths);
    static_cast<void>(solver.solve({order.round, order.first_paths, order.tasks}, sums, &watcher));
}

}  // namespace

TeamOrder TeamHelper::help(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    RunTeam& team,
    TeamOrder order) {
    const std::vector<Trace> traces = traces_of(scene, time_steps, spec);
    const std::uint64_t point = order.point;
    while (order.kind == TeamOrder::kTrace && order.point == point) {
        const auto trace = std::find_if(traces.begin(), traces.end(), [&](const Trace& each) {
            return each.time_step == order.time_step;
        });
        order =
            help_time_step(scene, time_steps[order.time_step].sources, trace->spec, team, order);
    }
    return order;
}

TeamOrder TeamHelper::help_time_step(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    RunTeam& team,
    TeamOrder order) {
    const std::unique_ptr<Sampler> sampler = make_sampler(spec.sampler);
    const ChosenMethod chosen = plan_run({scene, sources, spec, *sampler, caster_});
    const RunSpec planned = planned_spec(spec, {.method = chosen.method});
    const PreparedScene prepared(
        scene, sources, planned.start_area, caster_.caster_for(scene, planned.accelerator, {}), {},
        planned.origins);
    const TeamOrder first = order;
    StopByTeam stop(team);
    RoundSolver solver(prepared, *sampler, planned, stop.token(), {.team = &team});
    while (order.kind == TeamOrder::kTrace && order.point == first.point &&
           order.time_step == first.time_step) {
        try {
            help_round(solver, prepared, order, stop);
        } catch (const StopRequested&) {  // the first process ends the run
        }
        order = team.order({});
    }
    return order;
}

}  // namespace quasimc

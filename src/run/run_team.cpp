#include "run/run_team.h"

#include <algorithm>
#include <utility>

#include "base/executor.h"
#include "base/parallel.h"
#include "base/stop.h"
#include "quasimc/run.h"
#include "run/plan_run.h"
#include "run/round_tracer.h"
#include "run/trace_spec.h"
#include "samplers/catalogue.h"
#include "transport/prepared_scene.h"

namespace quasimc {
namespace {

__extension__ using Wide = __int128;

/// Numbers that 2^31 processes could add up: a bin as two halves.
constexpr unsigned kHalf = 32;
constexpr std::int64_t kLowHalf = (std::int64_t{1} << kHalf) - 1;
/// Bins that are sent at a time.
constexpr std::size_t kBinsAtOnce = std::size_t{1} << 18U;

void put_steps(const ExactBins& bins, std::size_t first, std::vector<std::int64_t>& numbers) {
    for (std::size_t i = 0; 3 * i < numbers.size(); ++i) {
        const ExactBins::Steps steps = bins.steps(first + i);
        numbers[3 * i] = steps.carries;
        numbers[3 * i + 1] = steps.low >> kHalf;
        numbers[3 * i + 2] = steps.low & kLowHalf;
    }
}

void take_steps(const std::vector<std::int64_t>& numbers, std::size_t first, ExactBins& bins) {
    for (std::size_t i = 0; 3 * i < numbers.size(); ++i) {
        const Wide low = (Wide{numbers[3 * i + 1]} << kHalf) + numbers[3 * i + 2];
        bins.add(
            first + i, ExactBins::Steps{
                           numbers[3 * i] + static_cast<std::int64_t>(low / ExactBins::kCarry),
                           static_cast<std::int64_t>(low % ExactBins::kCarry)});
    }
}

/// Progress that looks whether the first process asks to give up.
std::function<void(double)> stop_with(const RunTeam& team, std::stop_source& stop) {
    return [&team, &stop](double) {
        if (team.is_stopped()) {
            stop.request_stop();
        }
    };
}

}  // namespace

void add_up(const RunTeam& team, Sums& sums) {
    for (ExactBins& bins : sums.replicates) {
        ExactBins total(bins.size());
        for (std::size_t first = 0; first < bins.size(); first += kBinsAtOnce) {
            std::vector<std::int64_t> numbers(3 * std::min(kBinsAtOnce, bins.size() - first));
            put_steps(bins, first, numbers);
            team.add_up(numbers);
            if (team.is_first()) {
                take_steps(numbers, first, total);
            }
        }
        bins = std::as_const(total);  // in place: workers may hold on to the bins
    }
}

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

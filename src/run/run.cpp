#include "quasimc/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/free_memory.h"
#include "base/process_time.h"
#include "base/stop.h"
#include "base/text.h"
#include "light/source_origins.h"
#include "results/evaluate.h"
#include "run/digest.h"
#include "run/evaluation_of.h"
#include "run/plan_run.h"
#include "run/run_control.h"
#include "run/run_view.h"
#include "run/sensor_run.h"
#include "run/simulator.h"
#include "run/trace_plan.h"
#include "run/trace_rounds.h"
#include "run/zero_result.h"
#include "samplers/hash.h"
#include "scene/sensors.h"
#include "sums/sum_data.h"
#include "transport/prepared_scene.h"

namespace quasimc {
namespace {

using Clock = Deadline::Clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// An audit: plain light tracing with independent random numbers.
TracePlan audit_plan(const RunSpec& spec, std::uint64_t paths_done) {
    constexpr double kMinPaths = 64;
    return {
        .method = Method::light_tracing,
        .seed = mix64(spec.seed ^ 0x6a09e667f3bcc908U),
        .paths = static_cast<std::uint64_t>(
            std::max(kMinPaths, std::round(spec.audit * static_cast<double>(paths_done)))),
        .max_paths = 0,
        .target_error = 0,
        .sampler = "monte_carlo",
        .roulette_threshold = 1,
        .organs_alone = true};
}

/// Has the other processes of a team prepare the run.
void order_to_prepare(const SumsOrigin& origin, std::size_t time_step, const RunSpec& spec) {
    if (origin.team != nullptr) {
        static_cast<void>(origin.team->order(
            {.is_prepare = 1,
             .point = origin.point,
             .time_step = time_step,
             .first_paths = spec.paths}));
    }
}

/// @throws InputError  if external sums do not match the run
void check_given(const Sums& sums, const PreparedScene& prepared, const RunSpec& spec) {
    const bool is_this_run = sums.digest() == digest_of(prepared, spec) &&
                             sums.paths() == spec.paths &&
                             sums->replicates.size() == spec.replicates;
    if (!is_this_run) {
        throw InputError(
            {{"sums", "they belong to another run", "scene, sources, options or version differ",
              ""}});
    }
}

/// Reports external sums as one round.
void report_given(const Sums& sums, const RunFacts& facts, const RunControl& control) {
    RoundsState state;
    state.done = sums.paths();
    state.cost.add(sums.paths(), 0);
    report(control, &RunListener::on_last_round, {facts, sums, state, sums.paths()});
}

void report_sums(const Sums& sums, const RunFacts& facts, const RunRole& role) {
    if (role.on_sums) {
        role.on_sums({sums, facts.prepared.scene(), facts.asked, role.of_sensors});
    }
}

/// Adds the work on sensors to a result. The run has reached its target if all that it is for have.
void add_work(
    const Result& sensors, const RunSpec& of_sensors, const RunSpec& of_organs, Result& result) {
    result.rays += sensors.rays;
    result.preparation_seconds += sensors.preparation_seconds;
    result.solve_seconds += sensors.solve_seconds;
    result.solve_cpu_seconds += sensors.solve_cpu_seconds;
    if (of_sensors.target_error > 0) {
        result.fraction_at_target =
            of_organs.target_error > 0
                ? std::min(result.fraction_at_target, sensors.fraction_at_target)
                : sensors.fraction_at_target;
    }
    const bool is_incomplete =
        result.stop != StopReason::finished && result.stop != StopReason::target_reached;
    if (!is_incomplete && sensors.stop != StopReason::finished &&
        sensors.stop != StopReason::no_light) {
        result.stop = sensors.stop;
    }
}

Stopped stopped_without_result(StopReason why, const RunSpec& spec) {
    if (why == StopReason::interrupted) {
        return {why, "stopped before the first round of paths was complete; there is no result"};
    }
    const std::string limit =
        spec.max_seconds > 0 ? fmt::format("max_seconds: {} s were", shortest(spec.max_seconds))
                             : "the time was";
    return {
        why, limit +
                 " over before a few paths were complete; there is no result; allow more time (a "
                 "large scene needs it for its preparation) or, for a closed space that absorbs "
                 "little, set max_depth"};
}

}  // namespace

Result run(
    const Scene& scene, const Sources& sources, const RunSpec& spec, const RunControl& control) {
    return Simulator().run(scene, sources, spec, control);
}

Result evaluate_run(
    const Sums& sums, const Scene& scene, const RunSpec& spec, const Sources& sources) {
    return evaluate(sums, scene, evaluation_of(scene, sources, spec));
}

Result Simulator::State::run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunControl& control,
    const RunRole& role) {
    Faults faults;
    check_run(scene, sources, spec, faults);
    faults.throw_if_any();

    // Each path of an audit takes about as long as one of the run. Sensors take as long as organs.
    const Deadline all = deadline_of(control, spec);
    const double others = spec.audit + (has_sensors(scene) ? 1 : 0);
    const Deadline deadline = others > 0 ? all.share(1 / (1 + others)) : all;
    EarlyStop early(control.stop);
    early.stop_at(deadline.latest());
    const Work work = work_of(control);
    try {
        const Clock::time_point start = Clock::now();
        const RunSpec organs = spec_of_organs(scene, spec);
        order_to_prepare(control.origin, role.time_step, spec);
        ChosenMethod chosen =
            plan_run({scene, sources, organs, sampler_for(spec.sampler), caster_, early.token()});
        RunSpec planned = planned_spec(organs, {.method = chosen.method});
        planned.origins = complete_origins(sources, spec.origins);
        Result result =
            trace({scene, sources, planned, control, work, deadline, role, start}, early);
        if (result.stop == StopReason::no_light) {
            chosen.reason = "no light reaches the scene; nothing was computed";
        }
        result.chosen = std::move(chosen);
        add_sunlit_of_hidden_suns(scene, sources, result);
        if (has_sensors(scene)) {
            planned = planned_spec(spec, {});
            planned.origins = complete_origins(sources, spec.origins);
            add_sensors(
                scene, sources, planned,
                {.stop = control.stop, .deadline = all.share(1 / (1 + spec.audit))},
                {.on_sums = role.on_sums, .of_sensors = true}, result);
        }
        if (spec.audit > 0) {
            add_audit(scene, sources, spec, {.stop = control.stop, .deadline = all}, result);
        }
        return result;
    } catch (const StopRequested&) {
        throw stopped_without_result(early.why(), spec);
    }
}

void Simulator::State::add_audit(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunControl& control,
    Result& result) {
    EarlyStop early(control.stop);  // the run's own may be used up
    early.stop_at(control.deadline.at());
    try {
        const RunSpec plain = planned_spec(spec, audit_plan(spec, result.paths));
        result.audit = compare_results(
            scene, result,
            trace({scene, sources, plain, control, {}, {}, {}, Clock::now()}, early));
    } catch (const StopRequested&) {
        result.stop = early.why();
    }
}

void Simulator::State::add_sensors(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunControl& control,
    const RunRole& role,
    Result& result) {
    EarlyStop early(control.stop);  // the run's own may be used up
    early.stop_at(control.deadline.latest());
    const Scene all = scene_with_sensors(scene);
    const RunSpec own = spec_of_sensors(scene, spec);
    try {
        Result sensors = sensors_of(
            trace({all, sources, own, control, {}, control.deadline, role, Clock::now()}, early),
            scene);
        sensors.chosen = {Method::from_organs, "paths start on the sensors"};
        add_sunlit_of_hidden_suns(scene_of_sensors(scene), sources, sensors);
        add_work(sensors, own, spec_of_organs(scene, spec), result);
        result.sensors = std::make_shared<const Result>(std::move(sensors));
    } catch (const StopRequested&) {
        Result none;
        none.stop = early.why();
        add_work(none, own, spec_of_organs(scene, spec), result);
    }
}

Result Simulator::State::light_on_sensors(
    const Scene& scene, const Sources& sources, const RunSpec& spec) {
    Faults faults;
    check_run(scene, sources, spec, faults);
    faults.throw_if_any();
    EarlyStop never({});
    const RunControl control;
    const Scene all = scene_with_sensors(scene);
    const RunSpec own = spec_of_sensors(scene, spec);
    return sensors_of(trace({all, sources, own, control, {}, {}, {}, Clock::now()}, never), scene);
}

Result Simulator::State::trace(const TraceInput& in, EarlyStop& early) {
    std::optional<PreparedScene> prepared;
    prepared.emplace(
        in.scene, in.sources, in.spec.start_area,
        caster_.caster_for(in.scene, in.spec.accelerator, early.token()), early.token(),
        in.spec.origins);
    if (prepared->lights().empty()) {
        return unlit_result(in.scene, in.spec);
    }
    const Clock::time_point first_round = Clock::now();
    const double cpu_before = process_cpu_seconds();
    const EvaluationSpec asked = evaluation_of(in.scene, in.sources, in.spec);
    const RunFacts facts{*prepared, in.spec, asked, in.role.time_step};
    if (in.role.given != nullptr) {
        check_given(*in.role.given, *prepared, in.spec);
        report_given(*in.role.given, facts, in.control);
        report_sums(*in.role.given, facts, in.role);
        return make_result(*in.role.given, in.scene, asked);
    }
    TracedRounds traced = trace_rounds(
        {facts, sampler_for(in.spec.sampler), in.control, in.work, in.deadline, early,
         in.role.seconds_after_stop, in.start, first_round});
    report_sums(traced.sums, facts, in.role);
    if (in.role.is_last && in.spec.audit == 0 && !has_sensors(in.scene)) {
        prepared.reset();
        caster_.forget();
        give_back_free_memory(in.scene.organs().size());
    }
    Result result = make_result(std::move(traced.sums), in.scene, asked);
    result.stop = traced.stop;
    result.fraction_at_target = traced.at_target;
    result.paths_before = traced.paths_before;
    result.rounds = std::move(traced.errors);
    result.preparation_seconds = std::chrono::duration<double>(first_round - in.start).count();
    result.solve_seconds = seconds_since(first_round);
    result.solve_cpu_seconds = process_cpu_seconds() - cpu_before + traced.cpu_seconds_of_others;
    return result;
}

}  // namespace quasimc

#include "quasimc/run.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/executor.h"
#include "base/free_memory.h"
#include "base/memory_need.h"
#include "base/parallel.h"
#include "base/process_time.h"
#include "base/stop.h"
#include "base/text.h"
#include "planner/planner.h"
#include "results/evaluate.h"
#include "run/digest.h"
#include "run/early_stop.h"
#include "run/evaluation_of.h"
#include "run/plan_run.h"
#include "run/preview_teller.h"
#include "run/round_tracer.h"
#include "run/rounds.h"
#include "run/run_checkpoint.h"
#include "run/simulator.h"
#include "samplers/hash.h"
#include "solvers/catalogue.h"
#include "transport/prepared_scene.h"

namespace quasimc {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Tells the caller how far the run is.
class Reporter {
  public:
    Reporter(const std::function<void(const Progress&)>& tell, Clock::time_point start)
        : tell_(tell), start_(start) {}

    void begin_round(const Rounds& rounds) {
        before_ = rounds.fraction_before();
        share_ = rounds.share();
        at_target_ = rounds.at_target();
    }
    /// What an executor tells of a round; empty if nobody hears of it.
    [[nodiscard]] std::function<void(double)> listener() {
        return tell_ ? [this](double part) { report(part); } : std::function<void(double)>();
    }

  private:
    /// @param part  of the round that is done
    void report(double part) {
        const double seconds = seconds_since(start_);
        // A run that is begun anew does not go back.
        fraction_ = std::max(fraction_, before_ + share_ * part);
        tell_({fraction_, seconds, seconds / fraction_, at_target_});
    }

    const std::function<void(const Progress&)>& tell_;
    Clock::time_point start_;
    double before_ = 0, share_ = 1, at_target_ = 0, fraction_ = 0;
};

/// The plainest run there is, with random numbers of its own.
RunSpec audit_spec(const RunSpec& spec, std::uint64_t paths_done) {
    constexpr double kFewestPaths = 64;
    RunSpec audit = spec;
    audit.sampler = "monte_carlo";
    audit.method = Method::light_tracing;
    audit.seed = mix64(spec.seed ^ 0x6a09e667f3bcc908U);
    audit.paths = static_cast<std::uint64_t>(
        std::max(kFewestPaths, std::round(spec.audit * static_cast<double>(paths_done))));
    audit.target_error = audit.max_seconds = 0;
    audit.max_paths = 0;
    audit.roulette_weight = 1;
    audit.ratios.clear();
    audit.groups.clear();
    audit.layer_heights.clear();
    audit.layers = 0;
    return audit;
}

/// Whether some source is a sun that shines, be it past the scene.
bool has_bright_sun(const Sources& sources) {
    return std::any_of(sources.begin(), sources.end(), [](const auto& source) {
        const auto spectrum = source->spectrum();
        return source->is_sun() &&
               std::any_of(spectrum.begin(), spectrum.end(), [](double x) { return x > 0; });
    });
}

/// A sun to which all of the scene is edge-on lights no part of any organ.
void add_sunlit_of_hidden_suns(const Scene& scene, const Sources& sources, Result& result) {
    if (result.sunlit_fraction.empty() && has_bright_sun(sources)) {
        result.sunlit_fraction.resize(scene.organs().size());
    }
}

/// The result of a scene into which no source sends light: what is known of it is exact.
Result unlit_result(const Scene& scene, const RunSpec& spec) {
    Result unlit = dark_result(scene, spec);
    unlit.stop = StopReason::no_light;
    unlit.fraction_at_target = spec.target_error > 0 ? 1 : 0;
    return unlit;
}

/// Whether paths from `first` on are a round that run() could trace.
void check_first_path(const Sampler& sampler, const RunSpec& spec, std::uint64_t first) {
    const bool is_whole = first % spec.paths == 0;
    if (!is_whole || (sampler.needs_power_of_two() && first > spec.paths)) {
        throw InputError(
            {{"first", std::to_string(first), "rounds of " + spec.sampler + " must be whole",
              "use 0 or " + std::to_string(spec.paths)}});
    }
}

/// Of the time of a run, what its audit leaves it: the audit's paths take about as long each.
double seconds_without_audit(const RunSpec& spec) {
    return spec.max_seconds / (1 + spec.audit);
}

/// Time beyond the limit in which the first few paths may end.
double grace_seconds(const RunSpec& spec, const RunControl& control) {
    constexpr double kLeast = 0.25;
    constexpr double kPart = 0.03;
    return control.grace_seconds.value_or(std::max(kLeast, kPart * spec.max_seconds));
}

/// Paths with which a run begins that has a limit of time; a power of two. From organs there are
/// so many that each organ gets a point; with bundles so many that the time goes by them.
std::uint64_t fewest_paths(const Scene& scene, const RunSpec& spec) {
    constexpr std::uint64_t kFewest = 256;
    if (spec.method == Method::ray_bundles) {
        constexpr std::uint64_t kTrianglesPerPath = 8;
        return std::max(kFewest, std::bit_ceil(scene.triangle_count() / kTrianglesPerPath));
    }
    if (spec.method != Method::from_organs) {
        return kFewest;
    }
    const auto measured = static_cast<std::uint64_t>(std::count_if(
        scene.organs().begin(), scene.organs().end(), [](const Organ& o) { return o.measured; }));
    return std::max(kFewest, std::bit_ceil(measured));
}

/// Has the other processes of a team prepare the run.
void order_to_prepare(const RunControl& control, const RunSpec& spec) {
    if (control.team != nullptr) {
        static_cast<void>(control.team->order(
            {.is_prepare = 1,
             .point = control.team->point,
             .moment = control.moment,
             .first_paths = spec.paths}));
    }
}

/// The result of the sums.
/// @param sums  to be kept, or to be given back as they are read
template <typename SomeSums>
Result make_result(SomeSums&& sums, const Scene& scene, const EvaluationSpec& asked) {
    const double estimates = static_cast<double>(scene.organs().size()) * kQuantities *
                             static_cast<double>(scene.bands().size());
    return make_big(
        fmt::format(
            "the results of {} organs in {} bands", scene.organs().size(), scene.bands().size()),
        estimates * sizeof(Estimate),
        [&] { return evaluate(std::forward<SomeSums>(sums), scene, asked); });
}

/// The result of the sums of a run that goes on.
Result preview_of(
    const Sums& sums, const Scene& scene, const EvaluationSpec& asked, Method method) {
    Result result = make_result(sums, scene, asked);
    result.chosen.method = method;
    return result;
}

/// @throws InputError  if sums from elsewhere are not those of the run
void check_given(const Sums& sums, const PreparedScene& prepared, const RunSpec& spec) {
    const bool is_this_run = sums.digest == digest_of(prepared, spec) && sums.paths == spec.paths &&
                             sums.replicates.size() == spec.replicates;
    if (!is_this_run) {
        throw InputError(
            {{"sums", "they are of another run", "scene, sources, options or version differ", ""}});
    }
}

Stopped stopped_without_result(StopReason why, const RunSpec& spec) {
    if (why == StopReason::interrupted) {
        return {why, "stopped before the first round of paths was complete: there is no result"};
    }
    return {
        why,
        fmt::format(
            "max_seconds: {} s were over before a few paths were traced: there is no result; allow "
            "more time, or, where light is caught in a closed space that absorbs little, set "
            "max_depth",
            shortest(spec.max_seconds))};
}

}  // namespace

Result run(
    const Scene& scene, const Sources& sources, const RunSpec& spec, const RunControl& control) {
    RunControl last = control;
    last.is_last = true;
    return Simulator().run(scene, sources, spec, last);
}

Result evaluate_run(
    const Sums& sums, const Scene& scene, const RunSpec& spec, const Sources& sources) {
    return evaluate(sums, scene, evaluation_of(scene, sources, spec));
}

Result Simulator::State::run(
    const Scene& scene, const Sources& sources, const RunSpec& spec, const RunControl& control) {
    Faults faults;
    check_run(scene, sources, spec, faults);
    faults.throw_if_any();

    EarlyStop early(control.stop);
    RunSpec planned = spec;
    planned.max_seconds = seconds_without_audit(spec);
    if (planned.max_seconds > 0) {
        early.set_limit(planned.max_seconds + grace_seconds(planned, control));
    }
    try {
        const Clock::time_point start = Clock::now();
        order_to_prepare(control, spec);
        ChosenMethod chosen = plan_run(scene, sources, spec, caster_, early.token());
        planned.method = chosen.method;
        Result result = trace(scene, sources, planned, control, early, start);
        if (result.stop == StopReason::no_light) {
            chosen.reason = "no light reaches the scene, nothing was traced";
        }
        result.chosen = std::move(chosen);
        add_sunlit_of_hidden_suns(scene, sources, result);
        add_audit(scene, sources, spec, control, early, result);
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
    EarlyStop& early,
    Result& result) {
    if (spec.audit == 0) {
        return;
    }
    try {
        if (spec.max_seconds > 0) {
            early.set_limit(spec.max_seconds);
        }
        const Result plain = trace(
            scene, sources, audit_spec(spec, result.paths), {.stop = control.stop}, early,
            Clock::now());
        result.audit = compare_results(scene, result, plain);
    } catch (const StopRequested&) {
        result.stop = early.why();
    }
}

Sums Simulator::State::sums(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    std::uint64_t first,
    const Share& share,
    const RunControl& control) try {
    Faults faults;
    check_run(scene, sources, spec, faults);
    faults.throw_if_any();
    RunSpec planned = spec;
    const Clock::time_point start = Clock::now();
    planned.method = plan_run(scene, sources, spec, caster_, control.stop).method;
    check_first_path(sampler_for(spec.sampler), spec, first);
    const PreparedScene prepared(
        scene, sources, planned.window, caster_.caster_for(scene, spec.engine, control.stop),
        control.stop);
    Sums sums = empty_sums(prepared, planned);
    sums.digest = digest_of(prepared, planned);
    if (prepared.lights().empty()) {
        sums.paths = sums.samples = planned.paths;
        return sums;
    }
    Reporter reporter(control.on_progress, start);
    Executor executor(thread_count(planned.threads), reporter.listener(), control.stop, share);
    make_solver({prepared, sampler_for(planned.sampler), planned, control.stop})
        ->solve({first, planned.paths}, executor, sums);
    return sums;
} catch (const StopRequested&) {
    throw Stopped(
        StopReason::interrupted, "stopped before all paths were traced: there are no sums");
}

std::optional<Sums> Simulator::State::trace_few(
    const PreparedScene& prepared, const RunSpec& spec, const RunControl& control) {
    const std::uint64_t paths = fewest_paths(prepared.scene(), spec);
    const bool may = control.stop.stop_requested() && control.seconds_after_stop > 0;
    if (!may || paths >= spec.paths) {
        return std::nullopt;
    }
    EarlyStop end({});
    end.set_limit(control.seconds_after_stop);
    Executor executor(thread_count(spec.threads), {}, end.token());
    RoundTracer tracer(prepared, sampler_for(spec.sampler), spec, executor, false);
    try {
        tracer.trace({0, paths});
    } catch (const StopRequested&) {
        return std::nullopt;
    }
    return tracer.sums();
}

Result Simulator::State::trace(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunControl& control,
    EarlyStop& early,
    Clock::time_point start) {
    std::optional<PreparedScene> prepared;
    prepared.emplace(
        scene, sources, spec.window, caster_.caster_for(scene, spec.engine, early.token()),
        early.token());
    if (prepared->lights().empty()) {
        return unlit_result(scene, spec);
    }
    const double build_seconds = seconds_since(start);
    if (control.sums != nullptr) {
        check_given(*control.sums, *prepared, spec);
        StateKeeper(control, *prepared, spec).finish_given(*control.sums);
        return make_result(*control.sums, scene, evaluation_of(scene, sources, spec));
    }

    const double cpu_before = process_cpu_seconds();
    const EvaluationSpec asked = evaluation_of(scene, sources, spec);
    Traced traced = trace_rounds(*prepared, spec, asked, control, early, {start, build_seconds});
    if (control.is_last && spec.audit == 0) {
        prepared.reset();
        caster_.forget();
        give_back_free_memory(scene.organs().size());
    }
    Result result = make_result(std::move(traced.sums), scene, asked);
    result.stop = traced.stop;
    result.fraction_at_target = traced.at_target;
    result.paths_before = traced.paths_before;
    result.rounds = traced.rounds;
    result.build_seconds = build_seconds;
    result.trace_seconds = seconds_since(start) - build_seconds;
    result.trace_cpu_seconds = process_cpu_seconds() - cpu_before + traced.cpu_seconds_of_others;
    return result;
}

Simulator::State::Traced Simulator::State::trace_rounds(
    const PreparedScene& prepared,
    const RunSpec& spec,
    const EvaluationSpec& asked,
    const RunControl& control,
    EarlyStop& early,
    const RunStart& start) {
    Reporter reporter(control.on_progress, start.time);
    Executor executor(thread_count(spec.threads), reporter.listener(), early.token());
    Rounds rounds(
        spec, fewest_paths(prepared.scene(), spec), start.build_seconds,
        control.stop.stop_possible());
    RoundTracer tracer(prepared, sampler_for(spec.sampler), spec, executor, early.is_possible());
    tracer.set_team(control.team, control.moment);
    StateKeeper keeper(control, prepared, spec);
    const auto known = [&] {
        return errors_so_far(tracer.sums(), prepared.scene(), asked, spec.target_error);
    };
    const auto at_target = [&] { return spec.target_error > 0 ? known().fraction_at_target : 0; };
    keeper.begin(rounds, tracer, at_target);
    PreviewTeller preview(control, [&](const Sums& sums) {
        return preview_of(sums, prepared.scene(), asked, spec.method);
    });
    preview.watch(tracer);
    std::vector<RoundErrors> errors;
    std::optional<Sums> few;
    while (const auto round = rounds.next()) {
        preview.begin_round(*round, tracer);
        reporter.begin_round(rounds);
        try {
            tracer.trace(*round, keeper.begin_round(*round));
        } catch (const StopRequested&) {
            few = tracer.has_sums() ? std::nullopt : trace_few(prepared, spec, control);
            if (!tracer.has_sums() && !few) {
                throw;
            }
            rounds.interrupt(early.why());
            break;
        }
        if (spec.max_seconds > 0) {
            early.set_limit(spec.max_seconds);
        }
        const bool is_told = rounds.asks_for_more() && !rounds.state().is_trial;
        RoundErrors now = is_told || spec.target_error > 0 ? known() : RoundErrors{};
        now.seconds = seconds_since(start.time);
        rounds.finish(now.seconds, now.fraction_at_target);
        if (is_told) {
            errors.push_back(now);
        }
        keeper.finish_round(rounds, tracer);
    }
    early.set_limit(INFINITY);
    if (!few && rounds.stop() != StopReason::interrupted) {
        keeper.finish(tracer);
    }
    const double before = few ? 0 : tracer.paths_before();
    const double of_others = tracer.cpu_seconds_of_others();
    Sums sums = few ? std::move(*few) : std::move(tracer).take_sums();
    return {std::move(sums), rounds.stop(), rounds.at_target(),
            before,          of_others,     std::move(errors)};
}

}  // namespace quasimc

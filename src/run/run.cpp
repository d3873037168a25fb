#include "quasimc/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <string>
#include <utility>

#include "base/executor.h"
#include "base/parallel.h"
#include "quasimc/series.h"
#include "results/evaluate.h"
#include "run/digest.h"
#include "run/rounds.h"
#include "run/simulator.h"
#include "samplers/hash.h"
#include "solvers/catalogue.h"
#include "solvers/planner.h"
#include "transport/prepared_scene.h"

namespace quasimc {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
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
    /// @param part  of the round that is done
    void report(double part) const {
        const double seconds = seconds_since(start_);
        const double fraction = before_ + share_ * part;
        tell_({fraction, seconds, seconds / fraction, at_target_});
    }

  private:
    const std::function<void(const Progress&)>& tell_;
    Clock::time_point start_;
    double before_ = 0, share_ = 1, at_target_ = 0;
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

}  // namespace

Result run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<void(const Progress&)>& on_progress) {
    return Simulator().run(scene, sources, spec, on_progress);
}

Result evaluate_run(const Sums& sums, const Scene& scene, const RunSpec& spec) {
    return evaluate(
        sums, scene, {ratio_bands(scene, spec), spec.direct_light, thread_count(spec.threads)});
}

Result Simulator::State::run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<void(const Progress&)>& on_progress) {
    Faults faults;
    check_run(scene, sources, spec, faults);
    faults.throw_if_any();

    RunSpec planned = spec;
    ChosenMethod chosen = plan_method(scene, sources, spec);
    planned.method = chosen.method;
    Result result = trace(scene, sources, planned, on_progress);
    if (result.stop == StopReason::no_light) {
        chosen.reason = "no light reaches the scene, nothing was traced";
    }
    result.chosen = std::move(chosen);
    add_sunlit_of_hidden_suns(scene, sources, result);
    if (spec.audit > 0) {
        const Result plain = trace(scene, sources, audit_spec(spec, result.paths), {});
        result.audit = compare_results(scene, result, plain);
    }
    return result;
}

Sums Simulator::State::sums(
    const Scene& scene, const Sources& sources, const RunSpec& spec, std::uint64_t first) {
    Faults faults;
    check_run(scene, sources, spec, faults);
    faults.throw_if_any();
    RunSpec planned = spec;
    planned.method = plan_method(scene, sources, spec).method;
    check_first_path(sampler_for(spec.sampler), spec, first);
    const PreparedScene prepared = prepare(scene, sources, planned);
    Sums sums = empty_sums(prepared, planned);
    sums.digest = digest_of(prepared, planned);
    if (prepared.lights().empty()) {
        sums.paths = sums.samples = planned.paths;
        return sums;
    }
    Executor executor(thread_count(planned.threads));
    make_solver({prepared, sampler_for(planned.sampler), planned})
        ->solve({first, planned.paths}, executor, sums);
    return sums;
}

PreparedScene Simulator::State::prepare(
    const Scene& scene, const Sources& sources, const RunSpec& spec) {
    return {scene, sources, spec.window, caster_for(scene, spec.engine)};
}

Result Simulator::State::trace(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<void(const Progress&)>& on_progress) {
    const Clock::time_point start = Clock::now();
    const PreparedScene prepared = prepare(scene, sources, spec);
    if (prepared.lights().empty()) {
        return unlit_result(scene, spec);
    }
    const auto solver = make_solver({prepared, sampler_for(spec.sampler), spec});
    Sums sums = empty_sums(prepared, spec);
    const double build_seconds = seconds_since(start);

    const double cpu_before = cpu_seconds();
    Reporter reporter(on_progress, start);
    Executor executor(
        thread_count(spec.threads),
        on_progress ? [&](double part) { reporter.report(part); } : std::function<void(double)>());
    const EvaluationSpec asked{ratio_bands(scene, spec), spec.direct_light, executor.workers()};
    Rounds rounds(spec);
    while (const auto round = rounds.next()) {
        reporter.begin_round(rounds);
        solver->solve(*round, executor, sums);
        rounds.finish(
            seconds_since(start),
            spec.target_error > 0 ? fraction_at_target(sums, scene, asked, spec.target_error) : 0);
    }

    Result result = evaluate(sums, scene, asked);
    result.stop = rounds.stop();
    result.fraction_at_target = rounds.at_target();
    result.build_seconds = build_seconds;
    result.trace_seconds = seconds_since(start) - build_seconds;
    result.trace_cpu_seconds = cpu_seconds() - cpu_before;
    return result;
}

}  // namespace quasimc

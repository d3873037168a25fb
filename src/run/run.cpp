#include "run/run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

#include "base/parallel.h"
#include "results/evaluate.h"
#include "run/rounds.h"
#include "run/simulator.h"
#include "samplers/hash.h"
#include "solvers/estimator.h"
#include "solvers/planner.h"
#include "sums/replicates.h"
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

/// Tells the caller how far the run is, a few times a second, from the caller's own thread only.
class Reporter {
  public:
    Reporter(const std::function<void(const Progress&)>& tell, Clock::time_point start)
        : tell_(tell), start_(start) {}

    void begin_round(std::uint64_t blocks, double done_before, double share, double at_target) {
        blocks_ = blocks;
        done_ = 0;
        before_ = done_before;
        share_ = share;
        at_target_ = at_target;
    }
    void block_done(unsigned worker) {
        const std::uint64_t done = ++done_;
        constexpr double kSecondsBetween = 0.2;
        if (!tell_ || worker != 0 || seconds_since(start_) - last_ < kSecondsBetween) {
            return;
        }
        last_ = seconds_since(start_);
        const double fraction =
            before_ + share_ * static_cast<double>(done) / static_cast<double>(blocks_);
        tell_({fraction, last_, last_ / fraction, at_target_});
    }

  private:
    const std::function<void(const Progress&)>& tell_;
    Clock::time_point start_;
    std::uint64_t blocks_ = 1;
    std::atomic<std::uint64_t> done_{0};
    double before_ = 0, share_ = 1, last_ = 0, at_target_ = 0;
};

/// Traces one round of every replicate.
void trace_round(
    const Estimator& estimator,
    const Round& round,
    std::vector<Workspace>& workspaces,
    Replicates& replicates,
    Reporter& reporter) {
    const std::uint64_t blocks = estimator.blocks(round);
    const auto workers = static_cast<unsigned>(workspaces.size());
    parallel_blocks(blocks * replicates.count(), workers, [&](std::uint64_t i, unsigned worker) {
        const auto replicate = static_cast<std::uint32_t>(i / blocks);
        Tally& tally = replicates.tally_for(worker, replicate);
        estimator.trace(round, replicate, i % blocks, workspaces[worker], tally);
        reporter.block_done(worker);
    });
    replicates.collect();
}

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

}  // namespace

Result run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<void(const Progress&)>& on_progress) {
    return Simulator().run(scene, sources, spec, on_progress);
}

Result Simulator::run(
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
    result.chosen = std::move(chosen);
    if (spec.audit > 0) {
        const Result plain = trace(scene, sources, audit_spec(spec, result.paths), {});
        result.audit = compare_results(scene, result, plain);
    }
    return result;
}

Result Simulator::trace(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<void(const Progress&)>& on_progress) {
    const Clock::time_point start = Clock::now();
    const PreparedScene prepared(scene, sources, spec.window, caster_for(scene, spec.engine));
    if (prepared.lights().empty()) {
        throw InputError({{"sources", "no light reaches the scene", "", "check directions"}});
    }
    const auto estimator = make_estimator(prepared, sampler_for(spec.sampler), spec);
    const double build_seconds = seconds_since(start);

    const double cpu_before = cpu_seconds();
    const unsigned threads = thread_count(spec.threads);
    Replicates replicates(
        tally_layout(prepared), spec.replicates, threads, spec.tally_memory_mb * 1e6,
        prepared.ground_regions());
    std::vector<Workspace> workspaces;
    workspaces.reserve(threads);
    for (unsigned i = 0; i < threads; ++i) {
        workspaces.emplace_back(prepared.bands());
    }
    Evaluation evaluation{prepared, *estimator, replicates, 0, threads, spec.direct_light};
    Reporter reporter(on_progress, start);
    Rounds rounds(spec);
    while (const auto round = rounds.next()) {
        reporter.begin_round(
            estimator->blocks(*round) * spec.replicates, rounds.fraction_before(), rounds.share(),
            rounds.at_target());
        trace_round(*estimator, *round, workspaces, replicates, reporter);
        evaluation.paths = round->first + round->count;
        rounds.finish(
            seconds_since(start),
            spec.target_error > 0 ? fraction_at_target(evaluation, spec.target_error) : 0);
    }

    Result result;
    evaluate_organs(evaluation, ratio_bands(scene, spec), result);
    result.budget = evaluate_budget(evaluation);
    result.escaped_is_remainder = !estimator->counts_escapes();
    result.paths = evaluation.paths;
    result.replicates = spec.replicates;
    result.rays = count_rays(replicates);
    result.stop = rounds.stop();
    result.fraction_at_target = rounds.at_target();
    result.build_seconds = build_seconds;
    result.trace_seconds = seconds_since(start) - build_seconds;
    result.trace_cpu_seconds = cpu_seconds() - cpu_before;
    return result;
}

}  // namespace quasimc
